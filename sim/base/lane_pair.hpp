// lane_pair.hpp - base/pair.h for eight vehicles: two numbers of each. A part of base/lane.hpp and of
// base/lane_c.hpp, which include it inside their namespace and define the types of eight numbers
// (pair_number_t) and eight flags (pair_flag_t).
#ifndef SIM_BASE_LANE_PAIR_HPP
#define SIM_BASE_LANE_PAIR_HPP

#define PAIR_COPIES
#define same_in_bits(a, b, bytes) (memcmp(a, b, bytes) == 0)

struct pair_bits_t {
  pair_flag_t a[2];
  LANE pair_flag_t operator[](int i) const { return a[i]; }
};
struct pair_t {
  pair_number_t a[2];
  LANE pair_number_t operator[](int i) const { return a[i]; }
  LANE pair_number_t &operator[](int i) { return a[i]; }
};
#define LANE_PAIR(sign)                                                                                      \
  LANE pair_t operator sign(pair_t x, pair_t y) {                                                            \
    return {{x.a[0] sign y.a[0], x.a[1] sign y.a[1]}};                                                       \
  }                                                                                                          \
  LANE pair_t operator sign(pair_number_t x, pair_t y) {                                                     \
    return {{x sign y.a[0], x sign y.a[1]}};                                                                 \
  }                                                                                                          \
  LANE pair_t operator sign(pair_t x, pair_number_t y) {                                                     \
    return {{x.a[0] sign y, x.a[1] sign y}};                                                                 \
  }                                                                                                          \
  LANE pair_t &operator sign##=(pair_t &x, pair_t y) {                                                       \
    return x = x sign y;                                                                                     \
  }
LANE_PAIR(+)
LANE_PAIR(-)
LANE_PAIR(*)
LANE_PAIR(/)
LANE pair_t operator-(pair_t x) {
  return {{-x.a[0], -x.a[1]}};
}
#define LANE_PAIR_COMPARED(sign)                                                                             \
  LANE pair_bits_t operator sign(pair_t x, pair_t y) {                                                       \
    return {{x.a[0] sign y.a[0], x.a[1] sign y.a[1]}};                                                       \
  }                                                                                                          \
  LANE pair_bits_t operator sign(pair_t x, pair_number_t y) {                                                \
    return {{x.a[0] sign y, x.a[1] sign y}};                                                                 \
  }
LANE_PAIR_COMPARED(<)
LANE_PAIR_COMPARED(>)
LANE_PAIR_COMPARED(>=)
LANE_PAIR_COMPARED(!=)
LANE pair_bits_t operator&(pair_bits_t x, pair_bits_t y) {
  return {{x.a[0] && y.a[0], x.a[1] && y.a[1]}};
}
LANE pair_bits_t operator|(pair_bits_t x, pair_bits_t y) {
  return {{x.a[0] || y.a[0], x.a[1] || y.a[1]}};
}
LANE pair_bits_t operator~(pair_bits_t x) {
  return {{!x.a[0], !x.a[1]}};
}
LANE pair_bits_t &operator&=(pair_bits_t &x, pair_bits_t y) {
  return x = x & y;
}
// True for any lane: a lane that has finished its loop goes on, and nothing more changes for it.
LANE bool pair_any(pair_bits_t x) {
  return ((x.a[0].bits() | x.a[1].bits()) & lanes_in) != 0;
}
LANE pair_t pair_of(const pair_number_t *p) {
  return {{p[0], p[1]}};
}
LANE void pair_put(pair_number_t *p, pair_t x) {
  p[0] = x.a[0];
  p[1] = x.a[1];
}
LANE pair_t pair_both(pair_number_t x) {
  return {{x, x}};
}
LANE pair_number_t pair_sum(pair_t x) {
  return x.a[0] + x.a[1];
}
LANE pair_t pair_where(pair_bits_t holds, pair_t x, pair_t y) {
  return {{where(holds.a[0], x.a[0], y.a[0]), where(holds.a[1], x.a[1], y.a[1])}};
}
LANE pair_t pair_min(pair_t x, pair_t y) {
  return pair_where(x < y, x, y);
}
LANE pair_t pair_max(pair_t x, pair_t y) {
  return pair_where(x > y, x, y);
}
LANE pair_t pair_sqrt(pair_t x) {
  return {{sqrt(x.a[0]), sqrt(x.a[1])}};
}
LANE pair_t pair_trunc(pair_t x) {
  return {{trunc(x.a[0]), trunc(x.a[1])}};
}
LANE pair_t pair_exp2_of_bits(pair_t x) {
  return {{exp2_of_bits(x.a[0]), exp2_of_bits(x.a[1])}};
}

// base/few.h, with two at a time: four numbers of eight vehicles would fill all registers.
#define SIM_BASE_FEW_H
#define FEW_N            2
#define FEW_INLINE       LANE
#define few_t            pair_t
#define few_bits_t       pair_bits_t
#define few_of           pair_of
#define few_put          pair_put
#define few_all          pair_both
#define few_sum          pair_sum
#define few_where        pair_where
#define few_exp2_of_bits pair_exp2_of_bits
#define few_any          pair_any
#define few_min          pair_min
#define few_max          pair_max
#define few_sqrt         pair_sqrt
#define few_trunc        pair_trunc

LANE void few_put_four(pair_number_t *p, pair_number_t a, pair_number_t b, pair_number_t c, pair_number_t d) {
  p[0] = a;
  p[1] = b;
  p[2] = c;
  p[3] = d;
}

#endif
