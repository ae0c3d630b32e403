#!/usr/bin/env python3
"""test_mutate.py - what mutants.py makes of a line, and whom it counts as noticed."""

import random
import sys

import mutants
import mutate

# A statement in a function, and all that it may become.
ROWS = [
    ("if (a < b) return 1;", ["deleted statement: ;", "negation: !(a < b)", "relational: <=", "relational: >=",
                              "deleted statement: ;", "constant: 0", "constant: 2"]),
    ("x = f_clamp(-y, 0.0f, 2.0f * m);", ["deleted statement: ;", "removed clamp: (-y)", "negation: ", "constant: 1.0f",
                                          "constant: 1.8f", "constant: 2.2f", "arithmetic: /"]),
    ("const float *p = &q[3];", ["constant: 2", "constant: 4"]),
    ("s->count++;", ["deleted statement: ;", "arithmetic: --"]),
    ('print("a < b"); // c < d', ["deleted statement: ;"]),
    ("x |= 0x10u;", ["deleted statement: ;", "arithmetic: &=", "constant: 0x11u"]),
    ("if (!ok && 1e-3f) {", ["negation: !(!ok && 1e-3f)", "negation: ", "relational: ||", "constant: 0.0001f",
                             "constant: 0.01f"]),
    ("case 1: x = v; break;", ["constant: 0", "constant: 2", "deleted statement: ;", "deleted statement: ;"]),
]  # fmt: skip


def complaints() -> list[str]:
    found = []
    for line, want in ROWS:
        got = [f"{m.kind}: {m.new}" for m in mutate.mutants(f"void f(void) {{\n{line}\n}}")]
        if sorted(got) != sorted(want):
            found.append(f"{line}\n  got  {sorted(got)}\n  want {sorted(want)}")
    lines = mutants.lines_of(["src/mixer.c", "src/outer.c"])
    for count in (1, 40, 2 * len(lines)):
        drawn = mutants.draw(lines, count, random.Random(7))
        places = [place for places in drawn for place in places]
        if len(drawn) != count or len(set(places)) != len(places):
            found.append(f"{count} draws: {len(drawn)}, and {len(places) - len(set(places))} twice")
        if drawn != mutants.draw(lines, count, random.Random(7)):
            found.append(f"{count} draws: another each time")
    return found


if __name__ == "__main__":
    wrong = complaints()
    mutants.equivalent()  # it refuses a row whose line has changed
    print("\n".join(wrong) or f"test_mutate.py: {len(ROWS)} lines give the mutants they should")
    sys.exit(1 if wrong else 0)
