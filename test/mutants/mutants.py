#!/usr/bin/env python3
"""mutants.py COUNT SEED [WORD] - puts COUNT small mistakes into the flight code, one at a time, and asks the tests.

Drawn by SEED, evenly over the lines of src and src/firmware that can hold one (of those files whose path has WORD); of
a line, a kind of mistake first, then its place. Said is the share that a test notices, and each that none does. Not
counted is what is no mistake: the same object code, or a row of equivalent.txt, where its reason stands.
Fails where less than 95 % are noticed.
"""

import os
import random
import sys
import textwrap
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import mutate
import trial

LEAST_SHARE = 0.95
HERE = Path(__file__).parent


@dataclass(frozen=True)
class Place:
    """A mutant in its file."""

    source: str
    text: str
    mutant: mutate.Mutant

    def line(self) -> int:
        return self.text.count("\n", 0, self.mutant.start) + 1

    def diff(self) -> str:
        """By content, not by line number: file, function, the lines as they are and as they become."""
        first = self.text.rfind("\n", 0, self.mutant.start) + 1
        last = self.text.find("\n", self.mutant.end)
        new = self.text[first : self.mutant.start] + self.mutant.new + self.text[self.mutant.end : last]
        lines = [f"{self.source} {function_at(self.text, first)}".rstrip()]
        lines += [f"- {x.strip()}" for x in self.text[first:last].splitlines()]
        lines += [f"+ {x.strip()}" for x in new.splitlines()]
        return "\n".join(lines)


def function_at(text: str, at: int) -> str:
    """The name of the function that a place is in; empty at file scope."""
    name = ""
    for line in text[:at].splitlines() + text[at:].splitlines()[:1]:
        if line[:1].isalpha() and "(" in line and not line.rstrip().endswith(";"):
            name = line[: line.index("(")].split()[-1].lstrip("*")
        elif line.startswith("}"):
            name = ""
    return name


def equivalent() -> set[str]:
    """The mutants that were shown to be no mistakes. One whose line is no longer there is refused."""
    found = set()
    for paragraph in (HERE / "equivalent.txt").read_text(encoding="utf-8").split("\n\n"):
        rows = [row for row in paragraph.strip().splitlines() if not row.startswith("#")]
        if not rows:
            continue
        if not any(row.startswith("= ") for row in rows):
            raise SystemExit(f"mutants: equivalent.txt: no reason (`= ...`) below: {rows[0]}")
        source, *function = rows[0].split()
        text = Path(source).read_text(encoding="utf-8") if Path(source).exists() else ""
        flat = {line.strip() for line in text.splitlines()}
        gone = [row for row in rows[1:] if row.startswith("- ") and row[2:] not in flat]
        if gone or (function and f"{function[0]}(" not in text):
            raise SystemExit(f"mutants: equivalent.txt: {source} has no such line any more: {(gone or function)[0]}")
        found.add("\n".join(row for row in rows if not row.startswith(("= ", "  "))))
    return found


def lines_of(sources: list[str]) -> list[list[Place]]:
    """Every line that can hold a mistake, with all that it can hold."""
    lines: dict[tuple[str, int], list[Place]] = {}
    for source in sources:
        text = Path(source).read_text(encoding="utf-8")
        for mutant in mutate.mutants(text):
            place = Place(source, text, mutant)
            lines.setdefault((source, place.line()), []).append(place)
    return list(lines.values())


def draw(lines: list[list[Place]], count: int, dice: random.Random) -> list[list[Place]]:
    """For each of COUNT mutants a list to try in turn, as the first may not compile; no place stands in two lists."""
    begin = dice.random()
    left = [ordered(line, dice) for line in lines]
    often = -(-count // len(lines))  # how many mutants come from one line
    taken = []
    for i in range(count):
        at = int((i + begin) * len(lines) / count) % len(lines)
        own = [left[at].pop(0) for _ in range(min(len(left[at]), max(1, len(lines[at]) // often)))]
        below = [left[(at + k) % len(lines)] for k in (1, 2, 3)]
        taken.append(own + [line.pop() for line in below if len(line) > 1])
    return taken


def ordered(line: list[Place], dice: random.Random) -> list[Place]:
    """A line's mutants at random, the kinds in turn: a line of digits holds other mistakes, too."""
    kinds: dict[str, list[Place]] = {}
    for place in dice.sample(line, len(line)):
        kinds.setdefault(place.mutant.kind, []).append(place)
    order = dice.sample(sorted(kinds), len(kinds))
    return [kinds[kind][i] for i in range(max(map(len, kinds.values()))) for kind in order if i < len(kinds[kind])]


def try_one(bench: trial.Bench, places: list[Place], named: set[str], folder: Path) -> tuple[Place, trial.Verdict] | None:
    for place in places:
        if place.diff() in named:
            return place, trial.Verdict("named")
        verdict = trial.judge(bench, place.source, place.mutant.of(place.text), folder)
        if verdict.what != "does not compile":
            return place, verdict
    return None


def tell_survivor(place: Place) -> None:
    print(f"\n{place.source}:{place.line()} ({place.mutant.kind})\n{place.diff()}", flush=True)


def tell(judged: list[tuple[Place, trial.Verdict]], seed: int) -> int:
    n = Counter(verdict.what for _, verdict in judged)
    own = sum(1 for place, v in judged if v.by and v.by in trial.files_of(place.source))
    counted = n["killed"] + n["survives"]
    share = n["killed"] / counted if counted else 0.0
    said = (
        f"{len(judged)} mutants of seed {seed}: {n['killed']} killed, {own} of them by the tests of their module; "
        f"{n['same object']} are the same object code, {n['named']} named as equivalent; {n['survives']} survive. "
        f"Killed: {100.0 * share:.1f} % of {counted} (at least {100.0 * LEAST_SHARE:.0f} %)"
    )
    print("", *textwrap.wrap(said, 110), sep="\n")
    return 0 if counted and share >= LEAST_SHARE else 1


def main(count: str, seed: str, word: str = "") -> int:
    if not (count.isdigit() and int(count) > 0 and seed.isdigit()):
        raise SystemExit(f"mutants: N={count} SEED={seed}: allowed are a count from 1 on and a seed from 0 on")
    sources = sorted(str(p) for p in [*Path("src").glob("*.c"), *Path("src/firmware").glob("*.c")] if word in str(p))
    if not sources:
        raise SystemExit(f"mutants: W={word}: no file of src or src/firmware has that in its name")
    words = {name: os.environ[name].split() for name in ("FLIGHT", "APP", "LINK", "LIBRARIES", "OBJECTS")}
    bench = trial.Bench(trial.Tools(*words.values()), Path(os.environ.get("O", "out"), "mutants"))
    named = equivalent()
    drawn = draw(lines_of(sources), int(count), random.Random(int(seed)))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        tried = [pool.submit(try_one, bench, places, named, bench.folder / str(i)) for i, places in enumerate(drawn)]
        judged = []
        for i, each in enumerate(tried):
            judged += filter(None, [each.result()])
            if each.result() and each.result()[1].what == "survives":
                tell_survivor(each.result()[0])
            if sys.stderr.isatty():
                print(f"\r{i + 1} of {len(drawn)}", end="", file=sys.stderr)
    return tell(judged, int(seed))


if __name__ == "__main__":
    os.environ.pop("SEED", None)  # of the draw, not of the flights
    os.environ.update(OMP_NUM_THREADS="1", FAULTS_SEEDS=trial.SEEDS_OF_FAULTS)  # the mutants share the cores
    sys.exit(main(*sys.argv[1:]))
