"""outside.py SEED SETS GAP OUT - vehicles of rotorpy with something hidden, diagnosed by GAP as its user would, and marked.

Each set is three flights in OUT/NUMBER with a columns and a vehicle file, all of them from what the user knows. What is
hidden stays in this program until the verdict is there, and goes into OUT/marks.json. JOBS sets are made at a time (2).
"""

import json
import multiprocessing
import os
import random
import subprocess
import sys
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path

import draw
import flights
import marks
import user

FLIGHTS = 3
DRAWS = 20  # a vehicle that cannot fly with what is hidden is drawn again
GAP_S = 600


def make(seed: str, folder: Path) -> tuple[list[draw.Hidden], list[Path], int]:
    for again in range(DRAWS):
        r = random.Random(f"{seed}/{again}")
        v, what = draw.vehicle(r), draw.hidden(r)
        draw.fit_to(v, what, r)
        try:
            return what, user.write(folder, v, [flights.fly(v, what, r) for _ in range(FLIGHTS)]), again
        except flights.Crashed:
            continue
    raise RuntimeError(f"set {seed}: no vehicle of {DRAWS} flies")


def diagnose(gap: str, folder: Path, logs: list[Path]) -> dict:
    verdict = folder / "verdict.json"
    verdict.unlink(missing_ok=True)
    done = subprocess.run(
        [gap, "--vehicle", folder / "vehicle.toml", "--columns", folder / "columns.toml", "--json", verdict, *logs],
        capture_output=True, text=True, timeout=GAP_S, env={**os.environ, "OMP_NUM_THREADS": "1"}, check=False)
    if done.returncode not in (0, 2):
        raise RuntimeError(f"{folder}: gap ended with {done.returncode}: {done.stderr.strip()}")
    if not verdict.exists():  # refused before there was anything to say
        return {"verdict": "refused", "effects": [], "unknown": None, "warnings": [done.stderr.strip()]}
    return json.loads(verdict.read_text())


def sit(job: tuple[int, int, str, Path]) -> dict:
    seed, number, gap, out = job
    folder = out / f"{number:03}"
    what, logs, again = make(f"{seed}/{number}", folder)
    names = [h.name for h in what if h.name != draw.NOISE]
    m = marks.mark(diagnose(gap, folder, logs), names)
    return {"set": number, "drawn_again": again, "truth": [asdict(h) for h in what], "mark": asdict(m)}


def said(one: dict) -> str:
    truth = " + ".join(f"{h['name']} {h['size']:.3g}" for h in one["truth"]) or draw.NOTHING
    m = one["mark"]
    answer = " + ".join(m["names"]) or m["verdict"]
    rest = f" + unknown {m['unknown']}" if m["unknown"] else f": {m['line']}" if m["line"] else ""
    return f"{one['set']:03} {truth} -> {answer}{rest}"


def main(seed: int, sets: int, gap: str, out: Path) -> None:
    jobs = [(seed, i, gap, out) for i in range(sets)]
    all_sets = []
    with multiprocessing.Pool(int(os.environ.get("JOBS", 2))) as pool:
        for one in pool.imap(sit, jobs):
            all_sets.append(one)
            print(said(one), flush=True)
    made = {"seed": seed, "sets": sets, "rotorpy": version("rotorpy"), "numpy": version("numpy"),
            "gap": subprocess.run([gap, "--version"], capture_output=True, text=True, check=True).stdout.strip()}
    (out / "marks.json").write_text(json.dumps({"made": made, "sets": all_sets}, indent=1) + "\n")
    print("\n" + ", ".join(f"{key} {value}" for key, value in made.items()))
    print(f"drawn again, because the vehicle could not fly: {sum(one['drawn_again'] for one in all_sets)}\n")
    print(marks.table([marks.Mark(**one["mark"]) for one in all_sets]))


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], Path(sys.argv[4]))
