// lane_leave.hpp - the way back from code of eight numbers to that of one: a part of base/lane.hpp and
// base/lane_c.hpp, which include it inside of their namespace.
//
// A function that was given lanes in registers may leave their upper halves set, and gcc 12 does not clear
// them behind its call. Each instruction of plain code then waits for what they hold: of flights side by side
// a fifteenth of the time. So whoever is called from plain code, and computes with lanes, is called by
// leave<>.
struct clean_t {
  ~clean_t() { _mm256_zeroupper(); }
};

template <auto job> struct leaving_t;

template <typename result_t, typename... told_t, result_t (*job)(told_t...)> struct leaving_t<job> {
  static result_t call(told_t... told) {
    const clean_t clean;
    return job(told...);
  }
};

template <auto job> constexpr auto leave = &leaving_t<job>::call;
