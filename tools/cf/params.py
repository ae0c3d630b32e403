"""params.py - list, get, set and store parameters."""

import difflib
import math
from collections.abc import Mapping
from fnmatch import fnmatch

from .app import NO_APP
from .craft import Craft, Param
from .errors import Failed, Refused
from .terminal import say
from .weights import read_once

COUNTS = ("ceil.commits", "ceil.noCommit")
RESTART = "desk.restart"  # of a simulated vehicle (sim/desk)

WHOLE = {
    "uint8_t": (0, 255),
    "uint16_t": (0, 65535),
    "uint32_t": (0, 2**32 - 1),
    "int8_t": (-128, 127),
    "int16_t": (-32768, 32767),
    "int32_t": (-(2**31), 2**31 - 1),
}


def number(value: float) -> str:
    return f"{value:.7g}" if isinstance(value, float) else str(value)


def known(name: str, all_names: Mapping[str, object], what: str = "parameter") -> str:
    """Refused: there is none of that name. Failed: the app is not there, whose name it would be."""
    if name in all_names:
        return name
    if name.split(".")[0] in ("ceil", "rls", "guard") and "ceil.commit" not in all_names and "ceil.zc" not in all_names:
        raise Failed(f"{name}: {NO_APP}")
    like = difflib.get_close_matches(name, list(all_names), 1, 0.5)
    hint = f"did you mean {like[0]}?" if like else "allowed are group.name as on the vehicle"
    raise Refused(f"{name}: no such {what}; {hint}")


def parse(text: str, all_params: Mapping[str, Param]) -> tuple[str, float]:
    """NAME=VALUE. Refused: an unknown name, no number, or one that the type does not hold."""
    name, equals, typed = text.partition("=")
    if not equals:
        raise Refused(f"{text}: no value; allowed is NAME=VALUE")
    row = all_params[known(name.strip(), all_params)]
    if not row.writable:
        raise Refused(f"{name}: is read-only")
    try:
        value = float(typed)
    except ValueError:
        value = math.nan
    if row.kind in WHOLE:
        least, most = WHOLE[row.kind]
        if not (value.is_integer() and least <= value <= most):
            raise Refused(f"{name}={typed}: allowed are whole numbers, {least} to {most}")
        return name.strip(), int(value)
    if not math.isfinite(value):
        raise Refused(f"{name}={typed}: no number; allowed is a finite number")
    return name.strip(), value


def list_all(vehicle: Craft, patterns: list[str]) -> None:
    rows = vehicle.params()
    chosen = [name for name in rows if not patterns or any(fnmatch(name, pattern) for pattern in patterns)]
    if not chosen:
        raise Refused(f"{' '.join(patterns)}: no parameter is called so; allowed are names and patterns like 'ceil.*'")
    for name in chosen:
        row = rows[name]
        more = ("" if row.writable else " read-only") + (" persistent" if row.persistent else "")
        say(f"{name:26} {number(row.value):>12} {row.kind}{more}")


def get(vehicle: Craft, names: list[str]) -> None:
    rows = vehicle.params()
    for name in [known(name, rows) for name in names]:
        say(f"{name} = {number(vehicle.get(name))}")


def set_all(vehicle: Craft, texts: list[str]) -> None:
    """Nothing is written unless everything can be. Failed: the vehicle took back what was written."""
    rows = vehicle.params()
    for name, value in [parse(text, rows) for text in texts]:
        if name == "ceil.commit":
            _commit(vehicle, int(value))
            continue
        if name == RESTART:
            vehicle.set(name, value)
            vehicle.sleep(1.0)  # it goes back to 0 by itself, and the app finishes its checks
            say(f"{name} {value:g} taken")
            continue
        vehicle.set(name, value)
        vehicle.sleep(0.05)  # the app judges it within a few milliseconds
        now = vehicle.get(name)
        if abs(now - value) > 1e-6 * max(1.0, abs(value)):
            raise Failed(f"{name}: {number(value)} was not taken, it is {number(now)}; allowed: see src/README.md")
        say(f"{name} = {number(now)}")


def _commit(vehicle: Craft, which: int) -> None:
    """The app sets ceil.commit back to 0; its counters say whether it took the weights."""
    done, refused = read_once(vehicle, COUNTS)
    vehicle.set("ceil.commit", which)
    after = read_once(vehicle, COUNTS)
    if after != [done + 1, refused]:
        raise Failed(f"ceil.commit: {which} was refused; allowed are 1 and 2, weights of -5 to 5, and not while it learns")
    say(f"ceil.commit {which} taken")


def store(vehicle: Craft, names: list[str]) -> None:
    rows = vehicle.params()
    for name in [known(name, rows) for name in names]:
        if not rows[name].persistent:
            raise Refused(f"{name}: cannot be stored; allowed are those that params list calls persistent")
    for name in names:
        vehicle.store(name)
        say(f"{name} stored")
