"""flights.py - the thesis's flights (section 5.3): tables over many seeds, pictures like figures 9 to 13, touches."""

import csv
import json
import math
import re
from collections import defaultdict
from pathlib import Path

import run

INDI = ["indi", "indi-theory", "indi-rbf", "indi-learned"]
CONTROLLERS = {
    **{who.replace("indi", "thesis", 1): f"--controller {who} --thesis-law" for who in INDI},
    **{who: f"--controller {who}" for who in [*INDI, "stock-pid", "stock-indi", "air-garage"]},
}
DRAWN = {
    "indi": "standard INDI",
    "indi-rbf": "INDI with the RBF fitted to the theory",
    "indi-learned": "INDI with the learned RBF",
}
LEVELS = ["real", "flown"]  # of noise
SEEDS = 10
HEAD = """\
Six degrees of freedom, ten flights each at each level of noise, 10 s at each distance, the last 5 s measured. Distances
are from the propellers to the ceiling, R is their radius. sd: over all flights and instants; oscillation: about each \
flight's own mean.
Each row: fly SCENARIO --noise LEVEL --controller CONTROLLER --integrator rk4 --from 1 --to 10, with what its table's \
head sets;
thesis*: indi* with --thesis-law.
"""
COLUMNS = """\
                commanded          mean            sd   error  oscil.   con-  flights  smallest gap   tilt
controller       mm     R      mm     R      mm     R      mm      mm  tacts touching      mm     R    deg"""


def fly(*options: object) -> str:
    return run.program("fly", *options, "--integrator", "rk4")


def fly_many(path: Path, flights: int, *options: object, first: int = 1) -> list[dict]:
    """What fly's JSON says of each of so many seeds."""
    fly(*options, "--from", first, "--to", first + flights - 1, "--json", path)
    found = [json.loads(line) for line in path.read_text().splitlines()]
    if len(found) != flights:
        raise run.Failed(f"{path}: not the {flights} flights that were asked for")
    return found


def number(part: dict, key: str) -> float:
    if not isinstance(part.get(key), (int, float)):
        raise run.Failed(f"fly's JSON has no number {key}")
    return part[key]


class Cell:
    """The flights of one controller at one distance."""

    def __init__(self, flights: list[dict], k: int):
        def each(key: str) -> list[float]:
            return [number(flight["segments"][k], key) for flight in flights]

        error, contacts = each("mean_error_mm"), each("contacts")
        self.n = len(flights)
        self.radius_mm = 1e3 * number(flights[-1], "rotor_radius_m")
        self.distance_mm = 1e3 * number(flights[-1], "ceiling_m") - 1e3 * each("setpoint_m")[-1]
        self.error = sum(error) / self.n
        self.sd2 = sum(sd**2 for sd in each("sd_mm")) / self.n
        spread = sum(e * e for e in error) / self.n - self.error * self.error  # variance of the flights' means
        self.spread = math.sqrt(max(spread, 0.0) + self.sd2)
        self.contacts, self.touching = sum(contacts), sum(c > 0 for c in contacts)
        self.calm = [sd for sd, c in zip(each("sd_mm"), contacts) if c == 0]
        self.low, self.tilt = min(each("min_gap_mm")), max(each("tilt_max_deg"))

    def row(self, who: str) -> str:
        radius, gap = self.radius_mm, self.distance_mm - self.error
        return (
            f"{who:14} {self.distance_mm:4.0f} {self.distance_mm / radius:5.2f}  {gap:6.1f} {gap / radius:5.2f}"
            f"  {self.spread:6.1f} {self.spread / radius:5.2f}  {self.error:6.1f}  {math.sqrt(self.sd2):6.1f}"
            f"  {self.contacts:5d} {self.touching:5d}/{self.n}  {self.low:6.1f} {self.low / radius:5.2f}  {self.tilt:5.1f}"
        )


def cells(flights: list[dict]) -> list[Cell]:
    """In the order in which they were flown, but for the first: that hovers far away."""
    return [Cell(flights, k) for k in range(1, len(flights[0]["segments"]))]


def flown_with(flights: dict[str, list[dict]], whose: str) -> str:
    """What the flight code flew with, as fly prints it; the peers have none."""
    sets = [each[0]["set"] for who, each in flights.items() if who.startswith(whose) and "set" in each[0]]
    if any(each != sets[0] for each in sets):
        raise run.Failed("not all with the same parameters")
    but = "".join(f" --set {key}={value}" for key, value in sets[0].items()) if sets else ""
    return f"{whose}*: parameters as shipped" + (f", but for{but}" if but else "")


def free_sd(last: dict[str, Cell]) -> None:
    of = [(who, cell, sum(cell.calm) / max(len(cell.calm), 1)) for who, cell in last.items()]
    print(f"\n{of[0][1].distance_mm:.0f} mm, flights that did not touch there: mean of their sd, and its ratio to the first")
    for who, cell, sd in of:
        ratio = f"{sd / of[0][2]:.2f}" if of[0][2] > 0 else "-"
        print(f"{who:14} {sd:6.2f} mm  {ratio:>5}  of {len(cell.calm)}" if cell.calm else f"{who:14}  none")


def table(flights: dict[str, list[dict]], sd_of_free: bool) -> None:
    """A row for each controller and distance, over all its flights."""
    at = {who: cells(each) for who, each in flights.items()}
    first = next(iter(at.values()))
    laws = [law for law in ("indi", "thesis") if any(who.startswith(law) for who in at)]
    print(*(flown_with(flights, law) for law in laws), sep="\n")
    print(f"R = {first[0].radius_mm:.2f} mm\n{COLUMNS}")
    for k in range(len(first)):
        print(*(each[k].row(who) for who, each in at.items()), sep="\n")
    if sd_of_free:
        free_sd({who: each[-1] for who, each in at.items()})


def mean_flight(out: Path, who: str) -> None:
    """Mean and standard deviation of the height over all flights by the thesis's law, at each instant, for the pictures."""
    at: dict[float, list[tuple[float, float]]] = defaultdict(list)
    rest = ceiling = 0.0
    told: dict[float, float] = {}
    for seed in range(1, SEEDS + 1):
        run.progress(f"flying pictures, {who} {seed}")
        fly("test-flight", "--controller", who, "--thesis-law", "--seed", seed, "--log", out / "log.csv")
        with (out / "log.csv").open() as log:
            for i, row in enumerate(csv.DictReader(log)):
                z = float(row["sim.z"])
                if i == 0:
                    rest, ceiling = z, z + float(row["sim.gap"])
                t = float(row["timestamp"]) / 1e3
                at[t].append((z, float(row["stateEstimate.z"]) + float(row["ceil.zc"]) + rest))
                told[t] = float(row["ctrltarget.z"]) + rest
    (out / "log.csv").unlink()
    lines = ["t,mean,sd,command,top,ceiling\n"]
    for t in sorted(at):
        n, z = len(at[t]), [z for z, _ in at[t]]
        mean, top = sum(z) / n, sum(top for _, top in at[t]) / n
        sd = math.sqrt(max(sum(each * each for each in z) / n - mean * mean, 0.0))
        lines.append(f"{t:.2f},{mean:.6f},{sd:.6f},{told[t]:.4f},{top:.6f},{ceiling:.6f}\n")
    (out / f"mean.{who}.csv").write_text("".join(lines))


def pictures(out: Path) -> str:
    """Figures 9 to 13, and the last one in letters."""
    for figure, (who, name) in enumerate(DRAWN.items(), 9):
        mean_flight(out, who)
        fly("close-flight", "--controller", who, "--thesis-law", "--seed", 1, "--log", out / f"close.{who}.csv")
        run.gnuplot("mean_flight", out, who=who, name=name, figure=figure, flights=SEEDS)
    run.progress("flying pictures, learning")
    learned = [" ".join(map(str, each["weights"])) for each in fly_many(out / "learned.jsonl", SEEDS, "learning-flight")]
    fitted = run.weights(run.program("fly", "--params"))
    run.gnuplot("learned_curves", out, learned=" ".join(learned), fitted=fitted, flights=SEEDS)
    run.progress()
    return run.letters(run.gnuplot("close_flight", out))


def flights() -> None:
    out = run.folder("flights")
    print(HEAD)
    for scenario, level in ((scenario, level) for scenario in ("test-flight", "close-flight") for level in LEVELS):
        flown = {}
        for who, options in CONTROLLERS.items():
            run.progress(f"flying {scenario}, {level}, {who}")
            path = out / f"{scenario}.{level}.{who}.jsonl"
            flown[who] = fly_many(path, SEEDS, scenario, "--noise", level, *options.split())
        run.progress()
        print(f"{scenario}, {level}")
        # All flights touch at the last distance of close-flight.
        table(flown, sd_of_free=scenario == "test-flight")
        print()
    print(pictures(out))
    run.pictures(out)


def touches(flights_each: int = 1000) -> None:
    """How often the thesis's flights touch the ceiling: many seeds of each, at each level of noise."""
    out = run.folder("touches")
    but = re.search(r"^parameters .*", fly("close-flight"), re.M)
    print(f"{but[0] if but else ''}; the second row: motors as the thesis has them")
    print("level  flight        controller    ordered  touched there  besides")
    thesis = "--thesis-law"
    motors = f"{thesis} --effect motor_lag:add=-0.0175 --set indiPos.tauMot=0.0625"
    rows = [("test-flight", "indi", 30, thesis), ("test-flight", "indi", 30, motors)]
    rows += [("close-flight", who, 20, thesis) for who in INDI[1:]]
    rows += [("test-flight", "indi", 30, "")] + [("close-flight", who, 20, "") for who in INDI]
    for level, (scenario, who, distance_mm, besides) in ((level, row) for level in LEVELS for row in rows):
        run.progress(f"flying {scenario}, {level}, {who}")
        options = ["--noise", level, "--controller", who, *besides.split()]
        all_of_them = fly_many(out / "all.jsonl", flights_each, scenario, *options)
        there = next(cell for cell in cells(all_of_them) if abs(cell.distance_mm - distance_mm) < 1e-3)
        run.progress()
        share = f"{there.touching} of {there.n}"
        print(f"{level:6} {scenario:13} {who:13} {distance_mm:4d} mm  {share:13}  {besides}".rstrip())
