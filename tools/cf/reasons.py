"""reasons.py - the app's reason bits as words, by the tables in include/flight/guard.h and flyable.h."""

import re
from pathlib import Path

HEADERS = Path(__file__).parents[2] / "include" / "flight"


def _table(header: str) -> tuple[str, ...]:
    rows = re.findall(r'^ +X\( *(\d+), .*"(.+)"\)', (HEADERS / header).read_text(encoding="utf-8"), re.MULTILINE)
    words_of = {int(bit): name for bit, name in rows}
    return tuple(words_of[bit] for bit in range(len(rows)))  # a bit that is left out or taken twice is a KeyError


GUARD = _table("guard.h")
FLYABLE = _table("flyable.h")
DECKS = ("flow deck v2", "multiranger deck")
ACTIONS = ("fly", "hold", "retreat", "hand over")
RETREAT = 2  # from this action on, the pilot no longer flies


def words(bits: int, names: tuple[str, ...]) -> str:
    """The names of the bits that are set; a bit without a name as a number."""
    said = [name for i, name in enumerate(names) if bits >> i & 1]
    rest = bits >> len(names) << len(names)
    return ", ".join(said + ([f"0x{rest:x}"] if rest else [])) or "none"
