// page.h - the page of the desk, page.html, as it is linked into the program.
//
// The page asks for /state twenty times a second and shows what it gets. All numbers are SI, places in world
// axes (x forward, y left, z up); null: not known.
//
//   {"t_s": 12.34, "speed": 1.0, "behind_s": 0.0, "drones": [{
//     "uri": "udp://127.0.0.1:19850",
//     "pos_m": [x, y, z], "q": [w, x, y, z],      where it is, body to world
//     "rotor_m": [[x, y, z], 4 of them], "radius_m": 0.0231,              in body axes
//     "floor_m": 0.0, "ceiling_m": 1.5, "height_m": 1.02, "setpoint_m": 1.0,
//     "gap_m": 0.12, "zc_m": 0.118,               to the ceiling: the truth, and what the app believes
//     "ratio": [4 numbers], "motor": [4 of 0..1], "weights": [7 numbers],
//     "guard_now": ["words"], "guard_latched": ["words"],
//     "state": "Flying", "controller": "app", "vbat_V": 4.1,
//     "clients": 1, "packets_in": 0, "packets_out": 0,
//     "lost": 0, "no_room": 0,                    packets lost in the air; answers that found no room
//     "dropped": 0, "strays": 0,                  not understood; from others than the client
//     "desk": [{"name": "ceiling", "value": 1.5, "min": 0.15, "max": 10.0, "unit": "m",
//               "what": "height of the ceiling", "kind": "number" or "switch"}]}]}
//
// Each entry of `desk` gets a slider or a button; the page knows none of them by name.
#ifndef SIM_DESK_PAGE_H
#define SIM_DESK_PAGE_H

#include <stddef.h>

extern const unsigned char page_html[]; // made by the build
extern const size_t page_size;
// The Content-Security-Policy: allows the page's own script and style, by their hashes, its own server, and
// nothing else.
extern const char page_policy[];

#endif
