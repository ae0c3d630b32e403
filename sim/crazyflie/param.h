// param.h - stand-in: the firmware's macros fill an ELF section with the parameter groups of the app.
//
// Types and bits as they go over the link; PARAM_PERSISTENT goes as bit 4 (link/link_params.c).
#ifndef CRAZYFLIE_PARAM_H
#define CRAZYFLIE_PARAM_H

#include "sections.h"

#define PARAM_INT8       0x00
#define PARAM_INT16      0x01
#define PARAM_INT32      0x02
#define PARAM_FLOAT      0x06
#define PARAM_UINT8      0x08
#define PARAM_UINT16     0x09
#define PARAM_UINT32     0x0A
#define PARAM_CORE       (1 << 5)
#define PARAM_RONLY      (1 << 6)
#define PARAM_PERSISTENT (1 << 8)

#define PARAM_GROUP_START(group)                               static const section_param_t section_params_##group[] = {
#define PARAM_ADD(type, name, address)                         {(type), #name, (address), 0},
#define PARAM_ADD_CORE(type, name, address)                    {(type) | PARAM_CORE, #name, (address), 0},
#define PARAM_ADD_WITH_CALLBACK(type, name, address, callback) {(type), #name, (address), (callback)},
#define PARAM_GROUP_STOP(group)                                                                              \
  { 0, 0, 0, 0 }                                                                                             \
  }                                                                                                          \
  ;                                                                                                          \
  static const section_param_group_t section_param_group_##group = {#group, section_params_##group};         \
  static const section_param_group_t *const section_param_##group                                            \
      __attribute__((section("crazyflie_params"), used)) = &section_param_group_##group;

typedef struct {
  bool valid;
  unsigned deck;                // 1: it is there
  const section_param_t *param; // null: a deck's parameter
} paramVarId_t;
#define PARAM_VARID_IS_VALID(id) ((id).valid)

// Know the deck parameters only.
paramVarId_t paramGetVarId(const char *group, const char *name);
unsigned paramGetUint(paramVarId_t id);

// Knows the app's parameters only; name: "group.name".
paramVarId_t paramGetVarIdFromComplete(const char *name);

// Writes the value, tells the client and calls back, as the firmware does.
void paramSetInt(paramVarId_t id, int value);
void paramSetFloat(paramVarId_t id, float value);

#endif
