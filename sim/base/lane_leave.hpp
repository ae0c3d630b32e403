// lane_leave.hpp - the return from code for eight vehicles to code for one: a part of base/lane.hpp and
// base/lane_c.hpp, which include it inside their namespace.
//
// A function that takes lanes in registers may leave the registers' upper halves set, and gcc 12 does not
// clear them after the call. Every instruction of plain code then depends on those halves, which costs a
// fifteenth of the time of flights side by side. So plain code must call a function that computes with lanes
// through leave<>.
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
