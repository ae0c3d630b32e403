"""by_height.py - the law that ships by the flight code's own height (height.own) and by the estimator's, near a ceiling."""

import json
import math

import run

FIRST, FLIGHTS = 95001, 1000  # seeds on which nothing was tuned
GAPS_MM = (100, 20, 18, 15)
# What flies: the law by the estimator's height; by its own height as shipped; by its own height with lag and delay known.
SHARP = {"tauMot": 0.08, "delay": 0.001, "walk": 0.02, "kp": 7, "kd": 11, "quick": 3.5, "catch": 0.15}
BY = {
    "0": ["height.own=0"],
    "1": ["height.own=1"],
    "sharp": ["height.own=1", *(f"height.{name}={value}" for name, value in SHARP.items())],
}
LEVELS = {"real": "still_mm", "flown": "gusts_mm"}  # disturbances at that level, as out/bound has them


def bounds(level: str) -> dict[int, float]:
    head, *rows = [line.split() for line in run.program("bound", "--noise", level, *GAPS_MM).splitlines()]
    return {round(float(row[0])): float(row[head.index(LEVELS[level])]) for row in rows}


def rms(values: list[float]) -> float:
    return math.sqrt(sum(each**2 for each in values) / len(values))


def rows(level: str, own: str, flights: list[dict], least: dict[int, float]) -> None:
    """Over those flights that had not touched at a larger distance."""
    for k in range(len(flights[0]["segments"])):
        gap = round(1e3 * (flights[0]["ceiling_m"] - flights[0]["segments"][k]["setpoint_m"]))
        here = [each["segments"][k] for each in flights]
        touching = sum(each["contacts"] > 0 for each in here)
        flights = [each for each in flights if each["segments"][k]["contacts"] == 0]
        if gap not in GAPS_MM:
            continue
        free = [each for each in here if each["contacts"] == 0]
        error = sum(each["mean_error_mm"] for each in free) / len(free)
        about, all_mm = rms([each["sd_mm"] for each in free]), rms([each["rms_mm"] for each in free])
        worst = max(each["rms_mm"] for each in free)
        print(
            f"{level:6} {own:>5} {gap:6d}  {error:6.2f}  {all_mm:5.2f}  {worst:5.2f}  {about:6.2f}  {least[gap]:5.2f}"
            f"  {about / least[gap]:5.2f}  {touching:4d} of {len(here)}"
        )


def by_height() -> None:
    path = run.folder("by_height") / "all.jsonl"
    last = FIRST + FLIGHTS - 1
    print(
        f"fly nearest-flight --set height.own=OWN --integrator rk4 --from {FIRST} --to {last}, 10 s at each distance,\n"
        "the last 5 s measured; over those flights that had not touched at a larger one. oscil.: about each flight's own\n"
        "mean; bound: out/bound; ratio: of oscil. to it. OWN sharp is 1, with\n"
        f"{' '.join(BY['sharp'][1:])}\n\n"
        "level    own  gap mm   error    rms  worst  oscil.  bound  ratio  touched there"
    )
    for level in LEVELS:
        least = bounds(level)
        for own, sets in BY.items():
            run.progress(f"flying height.own {own}, {level}")
            many = ["--from", FIRST, "--to", last, "--json", path]
            options = [*(word for each in sets for word in ("--set", each)), "--noise", level, "--integrator", "rk4"]
            run.program("fly", "nearest-flight", *options, *many)
            run.progress()
            rows(level, own, [json.loads(line) for line in path.read_text().splitlines()], least)
