// page.h - the page of the desk, page.html, as it stands in the program.
//
// It asks for /state twenty times a second and shows what it gets. All numbers are SI, places in the world (x
// forward, y left, z up), null is what is not known:
//
//   {"t_s": 12.34, "speed": 1.0, "behind_s": 0.0, "drones": [{
//     "uri": "udp://127.0.0.1:19850",
//     "pos_m": [x, y, z], "q": [w, x, y, z],      where it is, body to world
//     "rotor_m": [[x, y, z], 4 of them], "radius_m": 0.0231,              in body axes
//     "floor_m": 0.0, "ceiling_m": 1.5, "height_m": 1.02, "setpoint_m": 1.0,
//     "gap_m": 0.12, "zc_m": 0.118,               to the ceiling: true, and as the app believes
//     "ratio": [4 numbers], "motor": [4 of 0..1], "weights": [7 numbers],
//     "guard_now": ["words"], "guard_latched": ["words"],
//     "state": "Flying", "controller": "app", "vbat_V": 4.1,
//     "clients": 1, "packets_in": 0, "packets_out": 0,
//     "lost": 0, "no_room": 0,                    packets: in the air, and answers too many to be kept
//     "dropped": 0, "strays": 0,                  not understood; of others than the client
//     "desk": [{"name": "ceiling", "value": 1.5, "min": 0.2, "max": 4.0, "unit": "m",
//               "what": "height of the ceiling", "kind": "number" or "switch"}]}]}
//
// What is in `desk` gets a slider or a button, without the page knowing it by name.
#ifndef SIM_DESK_PAGE_H
#define SIM_DESK_PAGE_H

#include <stddef.h>

extern const unsigned char page_html[]; // made by the build
extern const size_t page_size;
// The Content-Security-Policy: its own script and style, known by their sums, its own server, and nothing
// else.
extern const char page_policy[];

#endif
