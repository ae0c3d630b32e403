"""gap.py - the workflow on examples: a hidden ceiling, other seeds, an effect that is added, recorded flights."""

import itertools
import json
import os
import re
import subprocess
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import run

HIDDEN = "--controller indi-theory --effect none --effect rotor_drag:k=1.7e-6"


def example() -> None:
    """Flies with a hidden effect, lets the workflow find it, flies the model that it wrote; then real flights."""
    out = run.folder("demo/gap")
    run.vehicle_under_ceiling(out / "vehicle.toml")
    # The flown ceiling effect has another form than those that are tried.
    run.typed(f"""for seed in 1 2 3 4; do
    {run.OUT}/fly test-flight {HIDDEN} --effect ceiling:form=square-root \\
      --seed $seed --log {out}/flight$seed.csv --log-rate 500 >/dev/null
  done""")
    run.typed(f"{run.OUT}/gap --vehicle {out}/vehicle.toml {run.FLY_COLUMNS} --out {out}/report {out}/flight?.csv")
    rows = (out / "report/curves.csv").read_text().splitlines(keepends=True)
    (out / "ceiling.csv").write_text("".join([rows[0], *(row for row in rows if row.startswith("ceiling,"))]))
    print(f"\n{run.letters(run.gnuplot('ceiling_curve', out))}\n")
    run.typed(f"{run.OUT}/fly test-flight {HIDDEN} \\\n    --vehicle {out}/report/model.toml | tail -n 1")
    if run.DATA and Path(run.DATA, "ground_effect").is_dir():
        print("\nReal flights over the ground:")
        vehicle = "--vehicle sim/vehicle/vehicles/cf21_neural_swarm.toml --columns tools/columns/neural_swarm.toml"
        held, logs = '"$DATA/ground_effect/21_randomwalk_s_cf50_02.csv"', '"$DATA"/ground_effect/21_randomwalk_s_cf50_*.csv'
        run.typed(f"{run.OUT}/gap {vehicle} --out {out}/ground \\\n    --hold-out {held} {logs}")


def answer(said: str) -> str:
    """The workflow's answer in a few words."""
    if missing := re.search(r"^Missing.*: (.*)\.$", said, re.M):
        return missing[1].replace("; and something that has no name", " + unknown")
    if re.search("^Something", said, re.M):
        return "no name, something unknown"
    return "nothing" if re.search("^Nothing", said, re.M) else "not told"


def other_seeds(sets: int = 8) -> None:
    """The example on other seeds: what is said where a ceiling alone is hidden, and where nothing is."""
    out = run.folder("seeds")
    run.vehicle_under_ceiling(out / "vehicle.toml")
    logs = [out / f"flight{k}.csv" for k in (1, 2, 3, 4)]
    answers: Counter[tuple[str, str]] = Counter()
    for hidden in ("nothing", "exponential", "square-root"):
        effect = [] if hidden == "nothing" else ["--effect", f"ceiling:form={hidden}"]
        for n in range(1, sets + 1):
            run.progress(f"{hidden}, set {n} of {sets}")
            for k, log in enumerate(logs, 1):
                seed = ["--seed", 1000 * n + k]
                run.program("fly", "test-flight", *HIDDEN.split(), *effect, *seed, "--log", log, "--log-rate", 500)
            for cut in ("whole", "airborne"):
                for log in logs if cut == "airborne" else []:
                    head, *rows = log.read_text().splitlines(keepends=True)
                    log.write_text("".join([head, *(row for row in rows if float(row.split(",", 1)[0]) > 7000)]))
                said = run.program("gap", "--vehicle", out / "vehicle.toml", *run.FLY_COLUMNS.split(), *logs)
                answers[f"{hidden}, {cut}", answer(said)] += 1
    run.progress()
    for (flown, names), n in sorted(answers.items()):
        print(f"{flown:24} {names:44} {n} of {sets}")


MASSES_G = (1, 3, 5)
MASS_MARKS = ("named", "in its family", "no name", "WRONG")


def mass_mark(verdict: dict) -> tuple[str, str]:
    """Where the mass stands in a verdict on flights with more mass under a ceiling, and the names that were said."""
    told = {e["name"]: {e["name"], *e["rivals"], *(e.get("family") or [])} for e in verdict["effects"]}
    words = "; ".join(" | ".join([name, *sorted(others - {name})]) for name, others in told.items())
    if any("mass" not in others and name != "ceiling" for name, others in told.items()):
        return "WRONG", words
    if "mass" in told:
        return "named", words
    return "in its family" if any("mass" in others for others in told.values()) else "no name", words


def mass_flights() -> None:
    """A user's own flights with more mass: three of each set, both integrators, with and without the ceiling's height."""
    out = run.folder("mass-flights")
    run.vehicle_under_ceiling(out / "with.toml")
    files = {"with": ["--vehicle", out / "with.toml"], "without": []}
    counts: Counter[tuple[int, str, str]] = Counter()
    firsts = [int(first) for first in (os.environ.get("SEEDS") or "1 201 301").split()]
    for grams, first, integrator in itertools.product(MASSES_G, firsts, ("sundials", "rk4")):
        logs = [out / f"flight{k}.csv" for k in range(3)]
        for k, log in enumerate(logs):
            flown = ["--effect", f"mass:add={grams / 1000}", "--seed", first + k, "--integrator", integrator, "--log", log]
            run.program("fly", "test-flight", *flown)
        for ceiling, vehicle in files.items():
            run.program("gap", *vehicle, "--json", out / "verdict.json", *logs)
            mark, words = mass_mark(json.loads((out / "verdict.json").read_text()))
            run.progress(f"{grams} g, seeds from {first}, {integrator}, {ceiling} ceiling_m: {mark}")
            if os.environ.get("SEEDS"):
                print(f"{grams} g, {first}, {integrator:8}, {ceiling:7}: {mark}: {words}")
            counts[grams, ceiling, mark] += 1
    run.progress()
    print(f"{'more mass':12}{'ceiling_m':12}{'sets':>6}" + "".join(f"{mark:>15}" for mark in MASS_MARKS))
    for grams, ceiling in itertools.product(MASSES_G, files):
        of = [counts[grams, ceiling, mark] for mark in MASS_MARKS]
        print(f"{grams:<2} g{'':8}{ceiling:12}{sum(of):6}" + "".join(f"{n:15}" for n in of))


def added_effect() -> None:
    """Tries what the page says of adding an effect: its file goes into a copy of the tree, is hidden, and is looked for."""
    page = Path("sim/effects/README.md").read_text()
    text, name = re.findall(r"^```c\n(// fx_([a-z_]+)\.c - .*?)^```$", page, re.M | re.S)[0]
    copy = run.folder("add-effect")
    for part in ("Makefile", "src", "include", "sim", "tools"):
        run.program("cp", "-a", part, copy)
    (copy / "out").mkdir()
    run.program("cp", "-a", run.OUT / "release", run.OUT / "gen", copy / "out")
    (copy / f"sim/effects/fx_{name}.c").write_text(text)
    env = {key: value for key, value in os.environ.items() if key not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS", "O")}
    run.program("make", "O=out", "out/fly", "out/gap", cwd=copy, env=env)
    run.vehicle_under_ceiling(copy / "out/vehicle.toml")
    logs = [f"out/flight{seed}.csv" for seed in (1, 2, 3, 4)]
    for seed, log in enumerate(logs, 1):
        run.progress(f"flying {seed} of 4")
        run.program("out/fly", "test-flight", *HIDDEN.split(), "--effect", f"{name}:k=0.03", "--seed", seed, "--log", log,
                    "--log-rate", 500, cwd=copy)  # fmt: skip
    run.progress()
    said = run.program("out/gap", "--vehicle", "out/vehicle.toml", *run.FLY_COLUMNS.split(), *logs, cwd=copy)
    # What is named, and what the held-out flight, flown again, gained.
    print("\n".join(re.findall(rf"^(?:(?:Missing|None|flown again).*|{name}:.*\n.*)", said, re.M)))


GROUND = [f"ground_effect/21_randomwalk_s_cf50_{n}.csv" for n in ("00", "02", "04")]
JANA = [f"imu_rpm_500hz/jana{n}.csv" for n in ("00", "03", "05", "10")]
RECORDED = [  # vehicle, columns, logs
    ("cf21_neural_swarm", "neural_swarm", GROUND),
    ("cf21_imrc_without_lag", "imrc", JANA),
    ("cf21_imrc", "imrc", JANA),
    ("cf21_brushless_37g", "imrc", [f"brushless/flight{n}.csv" for n in ("00", "12", "22")]),
    ("cf21_nanobench", "nanobench", ["nanobench/B2_circle_slow_rep1.csv", "nanobench/B5_helix_fast_rep1.csv"]),
    ("quad15", "quad15", ["quad15/hovering.csv"]),
    ("cf_inner_loop_id", "inner_loop_id", ["inner_loop_id/data_1901.csv"]),
    ("cf21_static_imu", "static_imu", ["static_imu/estAcceleration.csv"]),
    ("cf21_air_garage", "air_garage", ["ceiling_gap/20240822_21_32_29.csv", "ceiling_gap/20240822_21_35_34.csv"]),
]
# The brushless vehicle as flown, 37 g; and one without lag and drag: whose file, what is changed in it, into what.
CHANGED = {
    "cf21_brushless_37g": ("cf21_brushless", r"^(mass_kg *= *)[0-9.]*", "0.037"),
    "cf21_imrc_without_lag": ("cf21_imrc", r"^(motor_tau_s *= *)[0-9.]*", "0.001"),
}
# Those of the verdict's notes that are printed.
NOTES = re.compile(r'"([a-z_]+ is withdrawn[^"]*|[a-z_]+: [0-9.e-]+ [a-z0-9/]+ is left[^"]*)"')


def in_short(said: str) -> Iterator[str]:
    lines = iter(said.splitlines())
    for line in lines:
        if re.match("gap:|Nothing|These|Something|unknown:", line):
            yield line
        elif named := re.match("(?!note|left)([a-z_]+(?: z)?): ", line):
            yield f"{named[1]} {next(lines)}"
        elif line.startswith("  force_z ") and " m/s2 " in line and " changes " not in line:
            yield "force_z m/s2, held out: {2} -> {3}".format(*line.split())
        elif line.startswith("  would do as well"):
            yield line.partition("; to tell")[0]
        elif "nearer than" in line:
            yield "held out, " + line.rpartition("held out, ")[2]


def recorded() -> None:
    """The workflow on flights that others recorded, in short: what is named, with which numbers."""
    if not run.DATA:
        print("skipped: no measured data")
        return
    out = run.folder("recorded")
    for changed, (vehicle, what, value) in CHANGED.items():
        text = Path(f"sim/vehicle/vehicles/{vehicle}.toml").read_text()
        (out / f"{changed}.toml").write_text(re.sub(what, rf"\g<1>{value}", text, flags=re.M))
    for vehicle, columns, logs in RECORDED:
        print(f"{vehicle}.toml, {' '.join(logs)}")
        file = out / f"{vehicle}.toml" if vehicle in CHANGED else f"sim/vehicle/vehicles/{vehicle}.toml"
        line = ["gap", "--vehicle", file, "--columns", f"tools/columns/{columns}.toml", "--json", out / "verdict.json"]
        said = run.program(*line, *(f"{run.DATA}/{log}" for log in logs), may_end_with=(0, 2), stderr=subprocess.STDOUT)
        for text in in_short(said.replace(f"{run.DATA}/", "")):
            print(" ", " ".join(text.split()))
        print(*(f"  {note}\n" for note in NOTES.findall((out / "verdict.json").read_text())), sep="")
