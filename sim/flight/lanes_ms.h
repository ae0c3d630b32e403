// lanes_ms.h - milliseconds of eight flights whose state lies in lanes (flight/lanes_eight.hpp); internal to
// flight/lanes_state.h.
#ifndef SIM_FLIGHT_LANES_MS_H
#define SIM_FLIGHT_LANES_MS_H

#ifdef __cplusplus
extern "C" {
#endif

// of: state_of_eight; told: pilot_in_t of eight. in: lanes to fly, a bit each; returns those that passed
// (lanes_senses_ms).
typedef struct {
  unsigned (*senses)(unsigned in, void *of);
  unsigned (*vehicle)(unsigned in, void *of, const void *told);
} lanes_ms_t;

// For registers of 256 and of 512 bits (lane_bits() of base/lane.h); both give the same bits.
extern const lanes_ms_t lanes_ms_256, lanes_ms_512;

#ifdef __cplusplus
}
#endif

#endif
