#!/usr/bin/env python3
"""coverage.py OBJECTS - which lines and branches the tests have run, by folder, from what gcov wrote below OBJECTS.

Of src and src/firmware every branch has to be taken, but for those of exceptions.txt; fails where one is not, and where
an exception is no longer one.
"""

import gzip
import json
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

WHOLE = ("src", "src/firmware")  # of these every branch
HERE = Path(__file__).parent


class Cover:
    """How often each line ran and each of its branches was taken, over all objects that hold them."""

    def __init__(self):
        self.lines: dict[tuple[str, int], int] = defaultdict(int)
        self.branches: dict[tuple[str, int], dict[tuple[str, int], int]] = defaultdict(lambda: defaultdict(int))

    def add(self, file: str, line: dict) -> None:
        at = file, line["line_number"]
        self.lines[at] += line["count"]
        for i, branch in enumerate(line["branches"]):
            self.branches[at][line.get("function_name", ""), i] += branch["count"]

    def read(self, objects: Path) -> None:
        notes = sorted(str(p) for p in objects.rglob("*.gcno"))
        for first in range(0, len(notes), 50):
            words = ["gcov", "--json-format", "--stdout", "--branch-probabilities", *notes[first : first + 50]]
            said = subprocess.run(words, capture_output=True, check=True).stdout
            for text in filter(None, (gzip.decompress(said) if said[:2] == b"\x1f\x8b" else said).splitlines()):
                for file in json.loads(text)["files"]:
                    for line in file["lines"] if not file["file"].startswith(("/", "out/")) else ():
                        self.add(file["file"], line)


def table(cover: Cover) -> None:
    lines, branches = defaultdict(list), defaultdict(list)
    for (file, _), count in cover.lines.items():
        lines[str(Path(file).parent)].append(count > 0)
    for (file, _), of_line in cover.branches.items():
        branches[str(Path(file).parent)] += [count > 0 for count in of_line.values()]
    print(f"{'':24}{'lines':>8}{'run':>9}{'branches':>12}{'taken':>9}")
    for folder in sorted(lines):
        print(f"{folder:24}{shares(lines[folder])}    {shares(branches[folder])}")


def shares(ran: list[bool]) -> str:
    return f"{len(ran):8}{100.0 * sum(ran) / len(ran):7.1f} %" if ran else f"{0:8}{'-':>9}"


def exceptions() -> dict[tuple[str, str], bool]:
    """Lines that may have a branch that is never taken, by file and content; each with its reason (`= ...`)."""
    found = {}
    for paragraph in (HERE / "exceptions.txt").read_text(encoding="utf-8").split("\n\n"):
        rows = [row for row in paragraph.strip().splitlines() if not row.startswith("#")]
        if rows and (len(rows) < 3 or not rows[2].startswith("= ")):
            raise SystemExit(f"coverage: exceptions.txt: allowed are a file, a line and `= reason`: {rows[0]}")
        if rows:
            found[rows[0].strip(), rows[1].strip()] = False
    return found


def never_taken(cover: Cover) -> list[str]:
    """What is wrong: branches that no test takes, and exceptions that are none."""
    allowed, wrong = exceptions(), []
    for (file, number), of_line in sorted(cover.branches.items()):
        if str(Path(file).parent) not in WHOLE or all(of_line.values()):
            continue
        text = Path(file).read_text(encoding="utf-8").splitlines()[number - 1].strip()
        if (file, text) in allowed:
            allowed[file, text] = True
        else:
            missed = sum(count == 0 for count in of_line.values())
            wrong.append(f"{file}:{number}: {missed} of {len(of_line)} branches never taken: {text}")
    unused = [(file, text) for (file, text), seen in allowed.items() if not seen]
    return wrong + [f"{file}: all branches are taken, or there is no such line: {text}" for file, text in unused]


def main(objects: str) -> int:
    cover = Cover()
    cover.read(Path(objects))
    table(cover)
    wrong = never_taken(cover)
    print("", *wrong, sep="\n") if wrong else print(f"all branches of {' and '.join(WHOLE)} are taken")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
