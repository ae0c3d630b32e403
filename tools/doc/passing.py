"""passing.py - a ceiling that nobody learned beforehand: learned in passing, and pushed against."""

import itertools
import math
from pathlib import Path

import flights
import run

FIRST, FLIGHTS = 94001, 1000  # seeds on which nothing was tuned
LEVELS = ["real", "flown"]  # of noise
STARTS = ["flat", "half", "double"]


def fly(
    name: str, scenario: str, level: str, *options: str, first: int = FIRST, count: int = FLIGHTS
) -> list[dict]:
    run.progress(f"flying {scenario}, {level} {' '.join(options)}")
    path: Path = run.folder(name) / "all.jsonl"
    flown = flights.fly_many(path, count, scenario, "--noise", level, *options, first=first)
    run.progress()
    return flown


def head(scenario: str, first: int = FIRST, count: int = FLIGHTS) -> None:
    print(f"fly {scenario} --noise LEVEL --integrator rk4 --from {first} --to {first + count - 1}\n")


def at(flight: dict, start: str, gap_mm: int) -> dict:
    """The segment at that distance of the flight from that start."""
    of_start = [each for each in flight["segments"] if each["label"] == start]
    return next(s for s in of_start if abs(1e3 * (flight["ceiling_m"] - s["setpoint_m"]) - gap_mm) < 1e-3)


def start_row(level: str, start: str, flown: list[dict]) -> str:
    text = f"{level:6} {start:7}"
    for gap_mm in (20, 15):
        here = [at(flight, start, gap_mm) for flight in flown]
        free = [s for s in here if s["contacts"] == 0]
        rms = math.sqrt(sum(flights.number(s, "rms_mm") ** 2 for s in free) / max(len(free), 1))
        text += f"  {rms:8.2f}  {len(here) - len(free):4d}/{len(here)}"
    learned = [next(row for row in flight["learned_at_3cm"] if row["start"] == start) for flight in flown]
    off = sum(flights.number(row, "excess_3cm") - flights.number(row, "there_3cm") for row in learned) / len(learned)
    share = sorted(flights.number(row, "slope_15mm") / flights.number(row, "there_15mm") for row in learned)
    wrong = sum(each <= 0.0 for each in share)
    return f"{text}  {off:10.4f}  {share[len(share) // 2]:7.2f}  {wrong:4d}/{len(share)}"


def passing() -> None:
    """Rms and touches at 20 and 15 mm, and what was learned at 3 cm, from each start."""
    head("in-passing")
    print("               20 mm:rms   touching  15 mm:rms  touching  3 cm:excess  15 mm:slope when 3 cm are left")
    print("level  start          mm                   mm               error     of true  wrong sign")
    for level in LEVELS:
        flown = fly("passing", "in-passing", level)
        for start in STARTS:
            print(start_row(level, start, flown))


def caught(fall: dict) -> bool:
    """Stands again below the ceiling, as the test of it has it."""
    return flights.number(fall, "overshoot_mm") < 50.0 and flights.number(fall, "rms_mm") < 20.0


def push_row(name: str, flown: list[dict]) -> str:
    pushes = [(s[i], s[i + 1]) for s in (flight["segments"] for flight in flown) for i in range(2, len(s), 2)]
    whole = [
        all(s[i]["contacts"] > 0 and caught(s[i + 1]) for i in range(2, len(s), 2))
        for s in (flight["segments"] for flight in flown)
    ]
    reached = sum(push["contacts"] > 0 for push, _ in pushes)
    lost = sum(not caught(fall) for _, fall in pushes)
    falls = sorted(flights.number(fall, "overshoot_mm") for _, fall in pushes)
    tilt = max(flights.number(push, "tilt_max_deg") for push, _ in pushes)
    return (
        f"{name} {sum(whole):4d}/{len(whole)}  {reached:4d}/{len(pushes)}  {lost:4d}/{len(pushes)}"
        f"  {falls[len(falls) // 2]:6.1f}  {falls[-1]:6.1f}  {tilt:5.1f}"
    )


def pushes() -> None:
    """How many flights reach the ceiling three times and are caught below it."""
    head("touch-and-go --controller indi-rbf --set height.own=OWN")
    print("           released   pushes that   not caught    fall mm          tilt")
    print("level  own and caught  touched                   median  largest  deg")
    for level, own in itertools.product(LEVELS, (0, 1)):
        flown = fly("pushes", "touch-and-go", level, "--set", f"height.own={own}")
        print(push_row(f"{level:6} {own:3d}", flown))
