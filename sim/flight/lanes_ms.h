// lanes_ms.h - milliseconds of eight flights whose state lies in lanes (flight/lanes_eight.hpp): the inside
// of flight/lanes_state.h.
#ifndef SIM_FLIGHT_LANES_MS_H
#define SIM_FLIGHT_LANES_MS_H

#ifdef __cplusplus
extern "C" {
#endif

// `of`: state_of_eight; `told`: pilot_in_t, of eight. In and out: lanes, a bit each (lanes_senses_ms).
typedef struct {
  unsigned (*senses)(unsigned in, void *of);
  unsigned (*vehicle)(unsigned in, void *of, const void *told);
} lanes_ms_t;

// By what processors have (lane_bits() of base/lane.h); the same bits come out.
extern const lanes_ms_t lanes_ms_256, lanes_ms_512;

#ifdef __cplusplus
}
#endif

#endif
