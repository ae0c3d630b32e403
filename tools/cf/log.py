"""log.py - log variables to a CSV file until Ctrl-C, or for so long."""

from pathlib import Path

from . import blocks
from .craft import Craft
from .errors import LinkLost, Refused
from .params import known
from .record import Record
from .terminal import progress, say

QUIET_S = 2.0  # without a packet for this long the link is taken as lost


def chosen(vehicle: Craft, names: list[str], configs: list[Path], period_ms: int) -> list[blocks.Block]:
    """What to log. Refused: unknown, nothing, or too much."""
    types = vehicle.logs()
    wanted = [block for place in configs for block in blocks.read(place)]
    wanted += blocks.pack([known(name, types, "log variable") for name in names], types, period_ms)
    for block in wanted:
        for name in block.types:
            known(name, types, "log variable")
    if not wanted:
        raise Refused("log: nothing to log; allowed are names of variables, and --config FILE or FOLDER")
    blocks.check(wanted)
    return wanted


def run(vehicle: Craft, wanted: list[blocks.Block], file: Path | None, duration_s: float) -> None:
    """LinkLost: what came so far is in a file that says so. Without a file: asks for the packets, and no more."""
    if not file:
        for block in wanted:
            vehicle.quiet(vehicle.stream(block, lambda *_: None))
        return
    record = Record("--out", file, wanted)
    why: BaseException | None = None
    try:
        _run(vehicle, wanted, record, duration_s)
    except KeyboardInterrupt:
        pass  # how a log without --for ends
    except BaseException as error:
        why = error
    name = record.end(whole=why is None)
    if why:
        so_far = f"what came so far, {record.rows} rows, is in {name}" if name else "no packet came"
        raise type(why)(f"{why}; {so_far}") from None
    say(f"{record.rows} rows in {name}" if name else "no packet came: no file")


def _run(vehicle: Craft, wanted: list[blocks.Block], record: Record, duration_s: float) -> None:
    streams = [vehicle.stream(block, record.take) for block in wanted]
    start_s = rows_s = vehicle.now()
    rows = 0
    while vehicle.now() - start_s < duration_s:
        vehicle.sleep(0.05)
        vehicle.alive()
        if record.trouble:
            raise Refused(f"--out: {record.trouble}")
        if record.rows != rows:
            rows, rows_s = record.rows, vehicle.now()
        if vehicle.now() - rows_s > QUIET_S + 2 * max(block.period_ms for block in wanted) / 1000:
            raise LinkLost("the link is lost (no log packets come)")
        progress(f"{vehicle.now() - start_s:.0f} s, {rows} rows; Ctrl-C ends it")
    for stream in streams:
        vehicle.quiet(stream)
