"""laws.py - the law that ships beside the thesis's, over the distance: rms about what was ordered, and touches."""

import json
import math

import run

FLIGHTS = 1000
FROM = 88001
LAWS = {
    "law that ships": "--controller indi-rbf",
    "its gains, no ceiling term": "--controller indi",
    "thesis's law": "--controller indi-rbf --thesis-law",
}
LEVELS = ["real", "flown"]


def row(who: str, level: str, flights: list[dict]) -> None:
    """Over those flights that had not touched before."""
    for k in range(1, len(flights[0]["segments"])):
        gap = 1e3 * (flights[0]["ceiling_m"] - flights[0]["segments"][k]["setpoint_m"])
        free = [each for each in flights if each["segments"][k]["contacts"] == 0]
        here = [each["segments"][k] for each in free]
        if not here or len(free) < len(flights) / 2:
            print(f"{who:27} {level:6} {gap:5.0f}  {'':31} {len(flights) - len(free):5d} of {len(flights)}")
            return
        mean = sum(each["mean_error_mm"] for each in here) / len(here)
        rms = math.sqrt(sum(each["rms_mm"] ** 2 for each in here) / len(here))
        own = math.sqrt(sum(each["sd_mm"] ** 2 for each in here) / len(here))
        low = min(each["min_gap_mm"] for each in here)
        touched = f"{len(flights) - len(free):5d} of {len(flights)}"
        print(f"{who:27} {level:6} {gap:5.0f}  {mean:6.2f}  {rms:6.2f}  {own:6.2f}  {low:6.1f}  {touched}")
        flights = free


def laws() -> None:
    out = run.folder("laws")
    print(
        f"fly nearest-flight --integrator rk4 --from {FROM} --to {FROM + FLIGHTS - 1}, 10 s at each distance, the last 5 s\n"
        "measured; over those flights that had not touched at a larger one. oscil.: about each flight's own mean.\n"
    )
    print("                                   ordered   error     rms  oscil. nearest  touched there")
    for level in LEVELS:
        for who, options in LAWS.items():
            run.progress(f"flying {who}, {level}")
            path = out / "all.jsonl"
            many = ["--from", FROM, "--to", FROM + FLIGHTS - 1, "--json", path]
            run.program("fly", "nearest-flight", *options.split(), "--noise", level, "--integrator", "rk4", *many)
            run.progress()
            row(who, level, [json.loads(line) for line in path.read_text().splitlines()])
