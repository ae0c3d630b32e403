#!/usr/bin/env python3
"""arrows.py [--svg] - who includes whom, folder by folder, read from the #include lines.

Fails with one line for each include that points up the stack or to its own floor, for each that is found nowhere or twice,
and for each circle among the modules of a folder (a .c and its .h are one). --svg prints a picture
of the stack.
"""

import re
import sys
from pathlib import Path
from typing import NamedTuple

# The stack from its bottom: a folder includes only from floors below its own.
FLOORS = [
    ["include/flight"],
    ["src"],
    ["src/firmware"],
    ["sim/base"],
    ["sim/plant"],
    ["sim/effects"],
    ["sim/vehicle"],
    ["sim/body"],
    ["sim/sense"],
    ["sim/crazyflie"],
    ["sim/link"],
    ["sim/logs", "sim/pilots"],
    ["sim/flight"],
    ["sim/flight/scenario", "sim/drone"],
    ["sim/desk"],
    ["sim/gap/1_read"],
    ["sim/gap/2_predict"],
    ["sim/gap/3_feedback"],
    ["sim/gap/4_candidates"],
    ["sim/gap/5_infer"],
    ["sim/gap/6_extend"],
    ["sim/gap/7_verify"],
    ["sim/gap"],  # runs the stages; the report words what they found
    ["sim/gap/8_report"],
    ["tools"],
]
FLOOR = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
FLIGHT = ("include/flight", "src", "src/firmware")
NATURE = ("sim/base", "sim/plant", "sim/effects", "sim/vehicle", "sim/body", "sim/sense")
FIRMWARE = ("src/firmware", "sim/crazyflie")  # name a header of the firmware, or its stand-in, without a folder
ROOTS = ("include", "src", "sim")
INCLUDE = re.compile(r'\s*#\s*include\s+"([^"]+)"')


class Arrow(NamedTuple):
    source: Path
    line: int
    header: str  # as it is written
    targets: list[Path]  # the files that it can mean

    @property
    def room(self) -> str:
        return str(self.source.parent)

    @property
    def to(self) -> str:
        return str(self.targets[0].parent)


def sources() -> list[Path]:
    found = [p for top in ("include", "src", "sim", "tools") for p in Path(top).rglob("*")]
    return sorted(p for p in found if p.suffix in (".c", ".h", ".cpp", ".hpp"))


def targets(source: Path, header: str) -> list[Path]:
    if "/" in header:
        return [p for p in (Path(root, header) for root in ROOTS) if p.is_file()]
    own = source.parent / header
    return [own] if own.is_file() and (str(source.parent) in (*FIRMWARE, "tools")) else []


def arrows() -> list[Arrow]:
    found = []
    for source in sources():
        for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if match:
                found.append(Arrow(source, number, match[1], targets(source, match[1])))
    return found


def wrong_with(arrow: Arrow) -> str | None:
    room = arrow.room
    if room not in FLOOR:
        return f"{room} has no floor in tools/lint/arrows.py"
    if not arrow.targets:
        return None if "/" not in arrow.header and room in FIRMWARE else "no such header; a header is named with its folder"
    if len(arrow.targets) > 1:
        return f"it is {' and '.join(map(str, arrow.targets))}"
    if arrow.to == room:
        return None
    if FLOOR.get(arrow.to, len(FLOORS)) >= FLOOR[room]:
        return f"{arrow.to} does not stand below {room}"
    return "nature does not know the flight code" if room in NATURE and arrow.to in FLIGHT else None


def circles(found: list[Arrow]) -> list[str]:
    graph: dict[Path, set[Path]] = {}
    for arrow in found:
        if len(arrow.targets) == 1 and arrow.to == arrow.room:
            graph.setdefault(arrow.source.with_suffix(""), set()).add(arrow.targets[0].with_suffix(""))

    def reached(start: Path) -> set[Path]:
        seen, todo = set(), [start]
        while todo:
            fresh = graph.get(todo.pop(), set()) - seen
            seen |= fresh
            todo += fresh
        return seen

    for module, others in graph.items():
        others.discard(module)
    reach = {module: reached(module) for module in graph}
    rings = {tuple(sorted(map(str, {m for m in reach[each] if each in reach.get(m, ())}))) for each in graph}
    return [f"circle: {', '.join(ring)}" for ring in sorted(rings) if ring]


# --- the picture ----------------------------------------------------------------------------------------------------------

ROW, WIDTH, BOX_W, BOX_H, LEFT, RIGHT = 46, 620, 168, 28, 96, 390


def place(room: str) -> tuple[float, float]:
    rooms = FLOORS[FLOOR[room]]
    x = LEFT if room in FLIGHT else RIGHT + (rooms.index(room) - (len(rooms) - 1) / 2) * (BOX_W + 12)
    return x, (len(FLOORS) - 1 - FLOOR[room]) * ROW + 24


def curve(room: str, to: str, n: int) -> str:
    """Straight down to the next floor; farther down a bow beside the column, the wider the farther."""
    (x, y), (u, v) = place(room), place(to)
    floors = FLOOR[room] - FLOOR[to]
    top, half = v - BOX_H / 2, BOX_W / 2
    if (room in FLIGHT) != (to in FLIGHT):
        way = f"M{x - half:g} {y} C{u:g} {y} {u:g} {y + 60} {u:g} {top:g}"
    elif floors == 1:
        way = f"M{x:g} {y + BOX_H / 2:g} L{x if abs(x - u) < half else u:g} {top:g}"
    else:
        side = 1 if min(x, u) >= RIGHT or to in FLIGHT else -1
        bow = max(x * side, u * side) * side + side * (half + 14 + 11 * floors)
        way = f"M{x + side * half:g} {y} C{bow:g} {y} {bow:g} {v} {u + side * half:g} {v}"
    return (
        f'<path stroke-width="{min(1 + n / 12, 4):.1f}" marker-end="url(#head)" d="{way}">'
        f"<title>{room} takes from {to}: {n}</title></path>"
    )


def direct(counts: dict[tuple[str, str], int]) -> dict[tuple[str, str], int]:
    """Those arrows alone that lead where no way through other folders does."""
    below: dict[str, set[str]] = {}
    for room in sorted(FLOOR, key=FLOOR.__getitem__):
        to = {b for a, b in counts if a == room}
        below[room] = to.union(*(below[b] for b in to))
    return {(a, b): n for (a, b), n in counts.items() if not any(b in below[c] for x, c in counts if x == a)}


def svg(found: list[Arrow]) -> str:
    counts: dict[tuple[str, str], int] = {}
    for arrow in found:
        if arrow.targets and arrow.to != arrow.room:
            counts[arrow.room, arrow.to] = counts.get((arrow.room, arrow.to), 0) + 1
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {len(FLOORS) * ROW}" '
        'font-family="sans-serif" font-size="13">',
        "<style>rect{fill:#fff;stroke:#456}path{fill:none;stroke:#8a97a5}</style>",
        '<marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto" '
        'markerUnits="userSpaceOnUse"><path d="M0 0 L8 4 L0 8 z" style="fill:#678;stroke:none"/></marker>',
        '<rect width="100%" height="100%" style="stroke:none"/>',
    ]
    lines += [curve(room, to, n) for (room, to), n in sorted(direct(counts).items())]
    for room in FLOOR:
        x, y = place(room)
        box = f'x="{x - BOX_W / 2:g}" y="{y - BOX_H / 2:g}" width="{BOX_W}" height="{BOX_H}" rx="5"'
        lines.append(f'<rect {box}/><text x="{x:g}" y="{y + 5}" text-anchor="middle">{room}</text>')
    return "\n".join([*lines, "</svg>", ""])


def main(words: list[str]) -> int:
    found = arrows()
    wrong = [f"{a.source}:{a.line}: includes {a.header}: {why}" for a in found if (why := wrong_with(a))]
    wrong += circles(found)
    print(*wrong, sep="\n", end="\n" if wrong else "", file=sys.stderr)
    if wrong:
        return 1
    if words == ["--svg"]:
        print(svg(found), end="")
    elif words:
        raise SystemExit("arrows.py: allowed: nothing, or --svg")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
