"""Marks a verdict against what was hidden.

right    A hidden effect is named: by its own name, or by a name of its family that lists it among its rivals (`rivals`, or
         `family` where that is a list): the answer says then that these flights cannot tell the two apart.
exact    Every hidden effect is named so, and nothing else.
false    A name that is no hidden effect, nor excused so. Beside a hidden battery_sag, whose zero lies elsewhere than the
         library's, mass and thrust_scale are not false, and not exact.
missed   A hidden effect that is not named; `unknown` is counted beside it.
refused  The log or the vehicle file was not taken.

A family holds effects that some flights cannot separate.
"""

from dataclasses import dataclass, field

import reliability

FAMILIES = (
    {"mass", "thrust_scale", "accel_bias", "battery_sag", "climb_inflow", "motor_damage", "thrust_curve"},  # constant lift
    {"motor_lag", "delay"},  # time between command and thrust
    {"wind", "accel_bias", "imu_misalignment", "motor_tilt"},  # constant push, without a turn about the vertical
    {"cg_offset", "motor_damage", "imu_misalignment", "motor_tilt"},  # constant moments
    {"rotor_drag", "body_drag", "wind"},  # forces against the velocity
    {"ceiling", "tof_bias", "battery_sag"},  # by place, where place and time go together
)
SAME_LIFT = {"mass", "thrust_scale"}


@dataclass
class Mark:
    hidden: list[str]
    verdict: str
    names: list[str]
    right: int = 0
    false: int = 0
    beside: int = 0
    unknown: str = ""
    stated: list[tuple[float | None, bool]] = field(default_factory=list)  # of each name: its probability, right
    line: str = ""  # the first warning

    @property
    def exact(self) -> bool:
        return self.verdict != "refused" and self.right == len(self.hidden) and not self.false and not self.beside


def excused(effect: dict, hidden: str) -> bool:
    family = effect.get("family")
    listed = set(effect["rivals"]) | (set(family) if isinstance(family, list) else set())
    return hidden in listed and any({hidden, effect["name"]} <= f for f in FAMILIES)


def what_it_names(effect: dict, hidden: list[str]) -> str | None:
    if effect["name"] in hidden:
        return effect["name"]
    return next((h for h in hidden if excused(effect, h)), None)


def place(unknown: dict | None) -> str:
    return "" if unknown is None else f"{unknown['channel']} at {unknown['coordinate']}"


def mark(verdict: dict, hidden: list[str]) -> Mark:
    m = Mark(hidden, verdict["verdict"], [e["name"] for e in verdict["effects"]], unknown=place(verdict.get("unknown")))
    m.line = (verdict["warnings"] or [""])[0] if m.verdict == "refused" else ""
    found = set()
    for effect in verdict["effects"]:
        named = what_it_names(effect, hidden)
        right = named is not None and named not in found
        found |= {named} if right else set()
        beside = not right and "battery_sag" in hidden and effect["name"] in SAME_LIFT
        m.beside += beside
        m.false += not right and not beside
        m.stated.append((effect.get("probability"), right or beside))
    m.right = len(found)
    return m


def share(n: int, of: int) -> str:
    return f"{n}/{of}" + (f" {100 * n / of:.0f} %" if of else "")


def row(what: str, marks: list[Mark]) -> str:
    hidden = sum(len(m.hidden) for m in marks)
    numbers = (len(marks), hidden, sum(m.right for m in marks), sum(m.exact for m in marks), sum(m.false for m in marks),
               sum(bool(m.unknown) for m in marks), sum(m.verdict == "refused" for m in marks))
    return f"{what:20}" + "".join(f"{n:8}" for n in numbers)


def table(marks: list[Mark]) -> str:
    """By what was hidden, and as a whole."""
    kinds = sorted({"+".join(m.hidden) if len(m.hidden) == 1 else "" for m in marks} - {""})
    head = f"{'hidden':20}" + "".join(f"{n:>8}" for n in ("sets", "hidden", "named", "exact", "false", "unknown", "refused"))
    lines = [head, row("nothing", [m for m in marks if not m.hidden])]
    lines += [row(kind, [m for m in marks if m.hidden == [kind]]) for kind in kinds]
    lines += [row("two", [m for m in marks if len(m.hidden) == 2]), row("all", marks), ""]
    some, none = [m for m in marks if m.hidden], [m for m in marks if not m.hidden and m.verdict != "refused"]
    lines.append("named: " + share(sum(m.right for m in some), sum(len(m.hidden) for m in some)) + " of what was hidden")
    lines.append("exact: " + share(sum(m.exact for m in some), len(some)) + " of the sets that hide something")
    lines.append("false names: " + share(sum(m.false for m in marks), sum(len(m.names) for m in marks)) + " of all names")
    lines.append("nothing hidden, and read: a name in " + share(sum(bool(m.names) for m in none), len(none)) +
                 ", unknown in " + share(sum(bool(m.unknown) for m in none), len(none)))
    lines += ["", "names, by the probability stated", reliability.table([one for m in marks for one in m.stated])]
    return "\n".join(lines)
