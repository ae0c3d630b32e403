// values.c - parameters and logs as numbers.
#include "values.h"

#include "log.h"
#include "param.h"
#include <math.h>
#include <string.h>

#define KIND(type) ((type)&0x0f)

static double within(double value, double min, double max) {
  return isnan(value) ? 0.0 : fmin(fmax(value, min), max);
}

void values_put(int param_type, void *at, double value) {
  const float real = (float)value;
  const uint8_t small = (uint8_t)within(value, 0.0, 255.0);
  const uint16_t middle = (uint16_t)within(value, 0.0, 65535.0);
  const uint32_t natural = (uint32_t)within(value, 0.0, 4294967295.0);
  const int8_t tiny = (int8_t)within(value, -128.0, 127.0);
  const int16_t brief = (int16_t)within(value, -32768.0, 32767.0);
  const int32_t whole = (int32_t)within(value, -2147483648.0, 2147483647.0);
  switch (KIND(param_type)) {
  case PARAM_FLOAT: memcpy(at, &real, sizeof real); break;
  case PARAM_UINT8: memcpy(at, &small, sizeof small); break;
  case PARAM_UINT16: memcpy(at, &middle, sizeof middle); break;
  case PARAM_UINT32: memcpy(at, &natural, sizeof natural); break;
  case PARAM_INT8: memcpy(at, &tiny, sizeof tiny); break;
  case PARAM_INT16: memcpy(at, &brief, sizeof brief); break;
  case PARAM_INT32: memcpy(at, &whole, sizeof whole); break;
  }
}

void values_put_log(int log_type, void *at, double value) {
  const float real = (float)value;
  const uint8_t small = (uint8_t)within(value, 0.0, 255.0);
  const uint32_t whole = (uint32_t)within(value, 0.0, 4294967295.0);
  switch (log_type) {
  case LOG_FLOAT: memcpy(at, &real, sizeof real); break;
  case LOG_UINT8: memcpy(at, &small, sizeof small); break;
  case LOG_UINT32: memcpy(at, &whole, sizeof whole); break;
  }
}

#define READ(type, at)                                                                                       \
  do {                                                                                                       \
    type value;                                                                                              \
    memcpy(&value, at, sizeof value);                                                                        \
    return (double)value;                                                                                    \
  } while (0)

double values_of_param(int param_type, const void *at) {
  switch (KIND(param_type)) {
  case PARAM_FLOAT: READ(float, at);
  case PARAM_UINT8: READ(uint8_t, at);
  case PARAM_UINT16: READ(uint16_t, at);
  case PARAM_UINT32: READ(uint32_t, at);
  case PARAM_INT8: READ(int8_t, at);
  case PARAM_INT16: READ(int16_t, at);
  case PARAM_INT32: READ(int32_t, at);
  }
  return (double)NAN;
}

double values_of_log(int log_type, const void *at) {
  switch (KIND(log_type)) {
  case LOG_FLOAT: READ(float, at);
  case LOG_UINT8: READ(uint8_t, at);
  case LOG_UINT16: READ(uint16_t, at);
  case LOG_UINT32: READ(uint32_t, at);
  case LOG_INT8: READ(int8_t, at);
  case LOG_INT16: READ(int16_t, at);
  case LOG_INT32: READ(int32_t, at);
  }
  return (double)NAN;
}
