"""bound.py - the least height error that any controller could have, and what is flown, as a ratio to it."""

import math
from pathlib import Path

import flights
import run

FIRST, FLIGHTS = 62001, 200  # seeds on which nothing was tuned
GAPS_MM = (100, 40, 20)
LEVELS = {"real": "still_mm", "flown": "gusts_mm"}  # disturbances at that level, as out/bound has them
# Each name, with the options of fly for it.
CONTROLLERS = {
    "stock-pid": "--controller stock-pid",
    "stock-indi": "--controller stock-indi",
    "indi": "--controller indi",
    "thesis-theory": "--controller indi-theory --thesis-law",
    "indi-theory": "--controller indi-theory",
}
HEAD = f"""\

Flown: close-flight, {FLIGHTS} flights each, seeds from {FIRST} on, the last 5 s of 10 s at each distance, propellers to
ceiling. about mean: rms about each flight's own mean, over all flights; ratio: to the bound, at real without any force, at
flown with its gusts; error: mean of the flights' means, and their sd; touching: flights that touched there.

level  gap mm  bound mm  controller     about mean  ratio  error mm     sd  touching"""


def bounds(level: str) -> dict[int, float]:
    """The bound at each distance, with what disturbs the vehicle at that level."""
    head, *rows = [line.split() for line in run.program("bound", "--noise", level, *GAPS_MM).splitlines()]
    return {round(float(row[0])): float(row[head.index(LEVELS[level])]) for row in rows}


def row(level: str, gap_mm: int, bound_mm: float, who: str, cell: flights.Cell) -> str:
    about_mean = math.sqrt(cell.sd2)
    of_means = math.sqrt(max(cell.spread**2 - cell.sd2, 0.0))
    return (
        f"{level:5}  {gap_mm:6d}  {bound_mm:8.2f}  {who:13}  {about_mean:10.2f}  {about_mean / bound_mm:5.1f}"
        f"  {cell.error:8.1f}  {of_means:5.1f}  {cell.touching:8d}"
    )


def level_table(level: str, path: Path) -> None:
    least = bounds(level)
    at: dict[str, dict[int, flights.Cell]] = {}
    for who, options in CONTROLLERS.items():
        run.progress(f"flying {level}, {who}")
        flown = flights.fly_many(path, FLIGHTS, "close-flight", "--noise", level, *options.split(), first=FIRST)
        at[who] = {round(cell.distance_mm): cell for cell in flights.cells(flown)}
    run.progress()
    for gap_mm in GAPS_MM:
        for who in CONTROLLERS:
            print(row(level, gap_mm, least[gap_mm], who, at[who][gap_mm]))


def bound() -> None:
    out = run.folder("bounds")
    run.typed(f"{run.OUT}/bound")
    print(HEAD)
    for level in LEVELS:
        level_table(level, out / "flown.jsonl")
