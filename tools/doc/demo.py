"""demo.py - the thesis's appendix A, and what is learned in simulation and from real flights."""

import json
from pathlib import Path

import run

FLIGHTS = [
    ("a4", "no ceiling effect", "--effect none"),
    ("a5", "standard INDI", ""),
    ("a6", "theory, lead 0.01 s", "--controller indi-theory --set ceil.kz=0.01"),
    ("a8", "theory, lead 0.3 s", "--controller indi-theory"),
    ("a10", "fitted RBF", "--controller indi-rbf"),
    ("learned", "learned RBF", "--controller indi-learned"),
]
CUTOFFS = [(0, "not filtered", "signals not filtered"), (8, "8 Hz filter", "8 Hz filter")]
VEHICLE = "sim/vehicle/vehicles/cf21_neural_swarm.toml"
LEARNED_FROM = [f"ground_effect/21_randomwalk_s_cf50_{n}.csv" for n in ("00", "04", "02")]  # the last is held out


def appendix_a(out: Path) -> None:
    print("Appendix A of the thesis, flown by the flight code")
    form = "  {:34} {:>12} {:>8} {:>10} {:>9}"
    rows = [form.format("step from 43 to 48 cm, ceiling 50", "overshoot mm", "t90 s", "gap mm", "contacts")]
    for cutoff, signals, _ in CUTOFFS:
        for name, label, options in FLIGHTS:
            run.progress(f"flying {label}, {signals}")
            log = ["--log", out / f"{name}_{cutoff}.csv"]
            said = run.program("fly", "appendix-a", *log, "--set", f"indiPos.cutoff={cutoff}", *options.split())
            step = next(line.split() for line in said.splitlines() if line.split()[:1] == ["0.48"])
            over = "0" if float(step[1]) < 0.005 else f"{float(step[1]):.2f}"
            t90 = "-" if step[3] == "-" else f"{float(step[3]):.2f}"
            rows.append(form.format(f"{label}, {signals}", over, t90, f"{float(step[8]):.1f}", step[9]))
    run.progress()
    print(*rows, sep="\n")
    for cutoff, _, signals in CUTOFFS:
        run.gnuplot("height", out, cutoff=str(cutoff), signals=signals)


def simulated_learning(out: Path) -> None:
    learned = run.weights(run.program("fly", "learning-1d", "--log", out / "learning.csv"))
    print("\nLearning flight, 10 to 2 cm in steps of 2 cm, noise N1: weights learned from nothing")
    print(*(f"  ceil.w{i} = {w}" for i, w in enumerate(learned.split(), 1)), sep="\n")
    run.gnuplot("learning", out, learned=learned)


def real_learning(out: Path) -> None:
    logs = [f"{run.DATA}/{log}" for log in LEARNED_FROM]
    line = f"--columns tools/columns/neural_swarm.toml --vehicle {VEHICLE} --surface ground".split()
    print("\nReal flights over the ground (two to learn from, one held out)")
    line += ["--points", out / "ground_points.csv", "--json", out / "ground.json"]
    print(run.program("learn", *logs[:2], "--hold-out", logs[2], *line), end="")
    learned = json.loads((out / "ground.json").read_text())["weights"]
    run.gnuplot("ground", out, learned=" ".join(map(str, learned)))


def demo() -> None:
    out = run.folder("demo")
    appendix_a(out)
    simulated_learning(out)
    if run.DATA and Path(run.DATA, "ground_effect").is_dir():
        real_learning(out)
    elif run.DATA:
        print(f"skipped: no ground_effect folder in {run.DATA}")
    else:
        print("\nskipped: no measured data (make demo DATA=DIR learns from real flights)")
    run.pictures(out)
