"""blocks.py - which variables go together over the radio: a log block carries 26 bytes of values.

The configuration files are cfclient's own: a JSON file is one block, a folder of them one category.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from .errors import Refused

BLOCK_BYTES = 26
BLOCKS_MAX = 16
VARIABLES_MAX = 128
PERIOD_MS = range(10, 2550, 10)
SIZE = {"uint8_t": 1, "uint16_t": 2, "uint32_t": 4, "int8_t": 1, "int16_t": 2, "int32_t": 4, "float": 4, "FP16": 2}


@dataclass(frozen=True)
class Block:
    name: str
    period_ms: int
    types: dict[str, str]  # type of each variable, as it is fetched


def size_bytes(block: Block) -> int:
    return sum(SIZE[kind] for kind in block.types.values())


def check_period(period_ms: int, where: str) -> None:
    if period_ms not in PERIOD_MS:
        raise Refused(f"{where}: {period_ms} ms; allowed are 10 to 2540 ms in steps of 10")


def pack(names: list[str], types: Mapping[str, str], period_ms: int) -> list[Block]:
    """Fills block after block, in the order given. types: of every variable that the vehicle has."""
    blocks: list[dict[str, str]] = []
    for name in dict.fromkeys(names):
        need = SIZE[types[name]]
        if not blocks or sum(SIZE[kind] for kind in blocks[-1].values()) + need > BLOCK_BYTES:
            blocks.append({})
        blocks[-1][name] = types[name]
    return [Block(f"cf{i}", period_ms, block) for i, block in enumerate(blocks)]


def check(blocks: list[Block]) -> None:
    """Refused: more than the vehicle can send."""
    count = sum(len(block.types) for block in blocks)
    if len(blocks) > BLOCKS_MAX or count > VARIABLES_MAX:
        raise Refused(
            f"log: {count} variables in {len(blocks)} blocks of {BLOCK_BYTES} bytes; "
            f"allowed are {VARIABLES_MAX} variables in {BLOCKS_MAX} blocks"
        )


def read(place: Path) -> list[Block]:
    """The block of a cfclient file, or those of a folder of them."""
    files = sorted(place.glob("*.json")) if place.is_dir() else [place]
    if not files:
        raise Refused(f"--config {place}: no .json file in it; allowed is a cfclient log configuration")
    return [_read_one(file) for file in files]


def _read_one(file: Path) -> Block:
    try:
        told = json.loads(file.read_text(encoding="utf-8"))["logconfig"]["logblock"]
        types = {str(v["name"]): str(v["fetch_as"]) for v in told["variables"]}
        block = Block(str(told["name"]), int(told["period"]), types)
    except OSError as error:
        raise Refused(f"--config {file}: {error.strerror}; allowed is a cfclient log configuration") from None
    except json.JSONDecodeError as error:
        raise Refused(f"{file}:{error.lineno}: {error.colno}: {error.msg}; allowed is JSON") from None
    except (KeyError, TypeError, ValueError):
        raise Refused(
            f"{file}: no cfclient log configuration; it has logconfig.logblock with name, period and "
            "variables, each with name and fetch_as"
        ) from None
    check_period(block.period_ms, str(file))
    for name, kind in types.items():
        if kind not in SIZE:
            raise Refused(f"{file}: {name} is fetched as {kind}; allowed are {', '.join(SIZE)}")
    if size_bytes(block) > BLOCK_BYTES:
        raise Refused(f"{file}: {size_bytes(block)} bytes; allowed are {BLOCK_BYTES} in a block")
    return block
