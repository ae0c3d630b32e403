// lane_fields.h - where the numbers of a struct lie, for one vehicle and for eight.
#ifndef SIM_BASE_LANE_FIELDS_H
#define SIM_BASE_LANE_FIELDS_H

#include <stddef.h>
#include <stdint.h>

enum lane_field_kinds { LANE_FLAG, LANE_I8, LANE_U8, LANE_I16, LANE_U16, LANE_32, LANE_64 };
typedef enum lane_field_kinds lane_field_kind_t;

typedef struct {
  uint32_t at; // bytes from the start of the struct
  lane_field_kind_t kind;
} lane_field_t;

#ifdef __cplusplus
#include <new>
#include <type_traits>

// While a struct is constructed, each of its numbers notes where it lies. All of this is static, one copy per
// source: the linker would merge shared copies, although sources are built for different processors.
static thread_local struct {
  const char *begin;
  lane_field_t *to; // null: nothing is noted
  int n, room;
} lane_notes;
static void lane_note(const void *at, lane_field_kind_t kind) {
  if (lane_notes.to && lane_notes.n < lane_notes.room)
    lane_notes.to[lane_notes.n++] = {(uint32_t)((const char *)at - lane_notes.begin), kind};
}

// Lists the numbers of a T in order of construction. Returns how many; from `room` on, some may be missing.
template <typename T> static int lane_fields_of(lane_field_t *to, int room, size_t *size) {
  alignas(64) static thread_local unsigned char place[sizeof(T)];
  lane_notes = {(const char *)place, to, 0, room};
  new (place) T;
  lane_notes.to = nullptr;
  *size = sizeof(T);
  return lane_notes.n;
}

template <typename T>
constexpr lane_field_kind_t lane_field_kind = std::is_same_v<T, bool> ? LANE_FLAG
                                              : sizeof(T) == 8        ? LANE_64
                                              : sizeof(T) == 4        ? LANE_32
                                              : sizeof(T) == 2 ? (std::is_signed_v<T> ? LANE_I16 : LANE_U16)
                                              : std::is_signed_v<T> ? LANE_I8
                                                                    : LANE_U8;
#endif

#endif
