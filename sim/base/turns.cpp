// turns.cpp - jobs that take turns in one thread, each on a stack of its own.
#include "base/turns.h"

#include <alloca.h>
#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <new>
#include <sanitizer/asan_interface.h>
#include <utility>

namespace {

using boost::context::fiber;

constexpr std::size_t stack_bytes =
    1 << 20; // the deepest flight takes a tenth; what is not touched takes no memory

constexpr std::size_t shift_bytes = 4096 / LANES + 64;

// A stack's outermost frames never return. The marks of the address sanitizer around them would later be
// taken for an overflow of whatever memory is mapped there next.
using guarded_t = boost::context::protected_fixedsize_stack;
struct own_stack_t : guarded_t {
  using guarded_t::guarded_t;
  void deallocate(boost::context::stack_context &s) noexcept {
    ASAN_UNPOISON_MEMORY_REGION(static_cast<char *>(s.sp) - s.size, s.size);
    guarded_t::deallocate(s);
  }
};

struct place_t {
  const turns_t *turns = nullptr;
  fiber job, back;
  void *what = nullptr;
};

thread_local place_t *here = nullptr;

void resume(place_t &p) {
  p.what = nullptr;
  here = &p;
  p.job = std::move(p.job).resume();
  here = nullptr;
}

// Starts the next jobs in an empty place until one waits; some jobs end without waiting.
void fill(const turns_t &t, place_t &p, int n, int &next) {
  while (!p.job && next < n) {
    const int i = next++;
    try {
      p.job = fiber(std::allocator_arg, own_stack_t(stack_bytes), [&t, &p, i](fiber &&back) {
        p.back = std::move(back);
        // Stacks begin at pages: without a shift all of them compete for the same cache lines.
        *static_cast<volatile char *>(alloca(1 + (std::size_t)(i % LANES) * shift_bytes)) = 0;
        t.job(t.context, i);
        return std::move(p.back);
      });
    } catch (const std::bad_alloc &) {
      t.job(t.context, i);
      continue;
    }
    resume(p);
  }
}

} // namespace

void turns_run(const turns_t *t, int n) {
  if (here) {
    for (int i = 0; i < n; i++) t->job(t->context, i);
    return;
  }
  place_t place[LANES];
  for (place_t &p : place) p.turns = t;
  int next = 0;
  for (bool any = true; any;) {
    void *what[LANES];
    any = false;
    for (int k = 0; k < LANES; k++) {
      if (place[k].job) resume(place[k]);
      fill(*t, place[k], n, next);
      what[k] = place[k].job ? place[k].what : nullptr;
      any = any || what[k];
    }
    if (any) t->meet(t->meet_context, what);
  }
}

bool turns_inside(void) {
  return here != nullptr;
}

bool turns_meet_at(void (*meet)(void *, void *const[LANES])) {
  return here != nullptr && here->turns->meet == meet;
}

void turns_wait(void *what) {
  place_t &p = *here;
  p.what = what;
  p.back = std::move(p.back).resume();
}
