"""declared.py - the app's parameters and logs as its source declares them: the macros, expanded by the compiler."""

import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

PARAM_H = """
#define PARAM_PERSISTENT 0x100
#define PARAM_RONLY 0x40
#define PARAM_CORE 0x20
#define PARAM_GROUP_START(g) @group g
#define PARAM_GROUP_STOP(g)
#define PARAM_ADD(type, name, address) @param (type) name address
#define PARAM_ADD_CORE(type, name, address) @param (type) name address
#define PARAM_ADD_WITH_CALLBACK(type, name, address, callback) @param (type) name address
"""
LOG_H = """
#define LOG_GROUP_START(g) @group g
#define LOG_GROUP_STOP(g)
#define LOG_ADD(type, name, address) @log (type) name address
#define LOG_ADD_CORE(type, name, address) @log (type) name address
"""
OTHER_H = {"platform_defaults.h": "#define THRUST2TORQUE 0.00735f\n"}


@dataclass(frozen=True)
class Row:
    name: str
    kind: str  # uint8_t ... float
    persistent: bool = False
    writable: bool = True
    initial: float = 0.0


@dataclass(frozen=True)
class Declared:
    params: tuple[Row, ...]
    logs: tuple[Row, ...]


def _kind(macro: str) -> str:
    """PARAM_UINT8, LOG_FLOAT ... as the C type."""
    word = re.search(r"(?:PARAM|LOG)_(FLOAT|FP16|U?INT\d+)", macro)
    assert word, f"no type in {macro}"
    kind = word[1].lower()
    return kind if kind == "float" else "FP16" if kind == "fp16" else f"{kind}_t"


def _expanded(source: Path, tree: Path) -> str:
    with tempfile.TemporaryDirectory() as stubs:
        for name, text in {"param.h": PARAM_H, "log.h": LOG_H, **OTHER_H}.items():
            (Path(stubs) / name).write_text(text)
        command = ["gcc", "-E", "-P", f"-I{stubs}", f"-I{tree / 'include'}", str(source)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def read(tree: Path) -> Declared:
    """All that src/firmware/*.c of this source tree declares."""
    params, logs = [], []
    for source in sorted((tree / "src" / "firmware").glob("*.c")):
        if not re.search(r"(PARAM|LOG)_ADD", source.read_text()):
            continue
        text = _expanded(source, tree)
        initial = dict(re.findall(r"\.([\w.\[\]]+) = (-?[\d.]+(?:e-?\d+)?)f?", text))
        group = ""
        for what, rest in re.findall(r"@(group|param|log)\s+(\w+|\([^)]*\)\s*\w+\s+&[\w.\[\]]+)", text):
            if what == "group":
                group = rest
                continue
            kind, name, address = re.fullmatch(r"\(([^)]*)\)\s*(\w+)\s+&(\S+)", rest).groups()
            field = re.sub(r"^\w+(\.tuned)?\.", "", address)
            row = Row(f"{group}.{name}", _kind(kind), "0x100" in kind, "0x40" not in kind, float(initial.get(field, 0)))
            (params if what == "param" else logs).append(row)
    return Declared(tuple(params), tuple(logs))


# What the commands use of the firmware itself; types as in release 2026.08.
STOCK = Declared(
    (
        Row("stabilizer.controller", "uint8_t", initial=6),
        Row("stabilizer.estimator", "uint8_t", initial=2),
        Row("kalman.resetEstimation", "uint8_t"),
        Row("deck.bcFlow2", "uint8_t", writable=False, initial=1),
        Row("deck.bcMultiranger", "uint8_t", writable=False, initial=1),
    ),
    (
        *(Row(f"stateEstimate.{axis}", "float") for axis in ("x", "y", "z", "vx", "vy", "vz", "roll", "pitch", "yaw")),
        *(Row(f"acc.{axis}", "float") for axis in "xyz"),
        *(Row(f"gyro.{axis}", "float") for axis in "xyz"),
        *(Row(f"ctrltarget.{axis}", "float") for axis in "xyz"),
        *(Row(f"motor.m{i}", "uint16_t") for i in range(1, 5)),
        Row("range.up", "uint16_t"),
        Row("range.zrange", "uint16_t"),
        Row("pm.vbat", "float"),
        Row("pm.state", "int8_t"),
        Row("supervisor.info", "uint16_t"),
    ),
)
