// log.h - stand-in: the firmware's macros fill an ELF section with the log groups of the app.
#ifndef CRAZYFLIE_LOG_H
#define CRAZYFLIE_LOG_H

#include "sections.h"

#define LOG_UINT8  1
#define LOG_UINT16 2
#define LOG_UINT32 3
#define LOG_INT8   4
#define LOG_INT16  5
#define LOG_INT32  6
#define LOG_FLOAT  7
#define LOG_CORE   0x20

#define LOG_GROUP_START(group)            static const section_log_t section_logs_##group[] = {
#define LOG_ADD(type, name, address)      {(type), #name, (address)},
#define LOG_ADD_CORE(type, name, address) {(type) | LOG_CORE, #name, (address)},
#define LOG_GROUP_STOP(group)                                                                                \
  { 0, 0, 0 }                                                                                                \
  }                                                                                                          \
  ;                                                                                                          \
  static const section_log_group_t section_log_group_##group = {#group, section_logs_##group};               \
  static const section_log_group_t *const section_log_##group                                                \
      __attribute__((section("crazyflie_logs"), used)) = &section_log_group_##group;

#endif
