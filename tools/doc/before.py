"""before.py - the complete loop beside an earlier commit of this repository, and by make fast: in turns, the best of all."""

import os
import re
import subprocess
import sys
from pathlib import Path

import run

TURNS = 3  # so that other load on the machine slows all commits
FIRST = "e12773f"  # before the first commit that made it faster
LINE = re.compile(r"^ *(.*\S) +(\d+) x real time", re.M)
WIDTH = re.compile(r" \(\d+ bits\)")  # of the processor's registers, not of the flight


def built(commit: str) -> Path:
    """The bench program of a commit, from a tree of its own under OUT."""
    tree = run.OUT / "before" / commit
    if not (tree / "out/bench").exists():
        run.progress(f"building {commit}")
        run.program("rm", "-rf", tree)
        tree.mkdir(parents=True)
        run.program("sh", "-euc", f'git archive "{commit}" | tar -x -C "{tree}"')
        env = ("env", "-u", "O", "-u", "MAKEFLAGS", "-u", "MAKELEVEL")
        run.program("sh", "-euc", " ".join(env) + f' make -s -C "{tree}" out/bench >"{tree}/log" 2>&1')
    return (tree / "out/bench").resolve()


def measured(bench: Path) -> dict[str, int]:
    """Ratios to real time by what is flown. An older program knows no part of its work and does all of it."""
    done = subprocess.run([bench, "loop"], capture_output=True, text=True, check=False)
    said = done.stdout if done.returncode == 0 else run.program(bench)
    lines = ((WIDTH.sub("", what), int(ratio)) for what, ratio in LINE.findall(said))
    return {what: ratio for what, ratio in lines if "complete loop" in what or "eight" in what}


def then_flown(what: str, of: dict[str, int]) -> int | None:
    """The same then; if no flights flew side by side then, one flight at a time by the same integrator."""
    if what in of or not what.startswith("eight") or any(name.startswith("eight") for name in of):
        return of.get(what)
    return next((ratio for name, ratio in of.items() if name.split(",")[-1] == what.split(",")[-1]), None)


def best(of: list[dict[str, int]]) -> dict[str, int]:
    return {what: max(one[what] for one in of) for what in of[0]}


def before() -> None:
    commit = os.environ.get("BEFORE") or FIRST
    ask = ("git", "rev-parse", "--short", "--verify", "--quiet", f"{commit}^{{commit}}")
    known = subprocess.run(ask, capture_output=True, text=True, check=False)
    if known.returncode != 0:
        raise run.Left(f"this copy of the repository has no commit {commit}")
    commit = known.stdout.strip()
    programs = [built(commit), (run.OUT / "bench").resolve()]
    fast = run.OUT / "fast/bin/bench"
    if fast.is_file() and run.program(fast, "--version") == run.program(programs[1], "--version"):
        programs.append(fast.resolve())
    elif fast.is_file():
        print(f"{fast} is of another commit, and left out; `make fast` builds it", file=sys.stderr)
    turns: list[list[dict[str, int]]] = [[] for _ in programs]
    for turn in range(TURNS):
        for which, bench in enumerate(programs):
            run.progress(f"turn {turn + 1} of {TURNS}")
            turns[which].append(measured(bench))
    run.progress()
    then, *later = (best(of) for of in turns)
    names = ["now", "make fast"][: len(later)]
    print(f"{'x real time':<62} {commit:>9}" + "".join(f" {name:>9} {'ratio':>6}" for name in names))
    for what in later[0]:
        was = then_flown(what, then)
        cells = (f" {of.get(what, '-'):>9} {f'{of[what] / was:.2f}' if was and what in of else '-':>6}" for of in later)
        print(f"{what:<62} {was or '-':>9}" + "".join(cells))
