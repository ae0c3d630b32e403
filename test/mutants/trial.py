"""trial.py - builds one mutant in a copy and asks the tests about it.

Only the changed file is compiled, with a trap on undefined behaviour; everything else was linked into one object before.
What its module's tests let by is compiled again as it ships and held against the original, bit for bit, and goes on to
the other tests where it differs.
"""

import re
import shutil
import subprocess
import threading
import time
from dataclasses import dataclass
from pathlib import Path

# Where a mistake shows that no module's tests notice. Tables of whole flights are left out: they take minutes, and
# what only they notice has no test of its own.
FLIGHTS = ("test_storm.c", "test_held.c", "test_corners.c", "test_learning_flight.c", "test_faults.c")
LEFT_OUT = ("test_flights.c", "test_flight_log.c")
SEEDS_OF_FAULTS = "5"  # of 4 a share of 82 % could not fail, which is refused (rig/share.h)
TRAPS = ("-O1", "-fsanitize=undefined", "-fno-sanitize=alignment", "-fsanitize-undefined-trap-on-error")
# libgcc's answer to lane_possible(), none of it: in the lanes of eight vehicles a mistake is not.
NO_LANES = """
struct { unsigned kind[3], has[1]; } __cpu_model;
unsigned __cpu_features2[4];
int __cpu_indicator_init(void) { return 0; }
"""
LINE = re.compile(r"^(\d+) passed, (\d+) failed$", re.MULTILINE)


@dataclass(frozen=True)
class Tools:
    """How the project builds: commands without their input and output."""

    flight: list[str]  # a file of src
    app: list[str]  # a file of src/firmware
    link: list[str]
    libraries: list[str]
    objects: list[str]  # of the tests' program

    def compiler_of(self, source: str) -> list[str]:
        words = self.app if source.startswith("src/firmware/") else self.flight
        kept = [w for w in words if not w.startswith(("-W", "-MM", "-MP"))]
        return [*kept, "-Werror=return-type", "-iquote", str(Path(source).parent)]


class Bench:
    def __init__(self, tools: Tools, folder: Path):
        self.tools, self.folder = tools, folder
        self.modules = {source_of(o): o for o in tools.objects if source_of(o)}
        self.seconds: dict[str, float] = {}  # of the tests of a file, with the original
        self.locks: dict[str, threading.Lock] = {f.name: threading.Lock() for f in Path("test").rglob("test_*.c")}
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        self.rest, alone = folder / "rest.o", folder / "alone.o"
        subprocess.run([tools.link[0], "-x", "c", "-", "-c", "-o", alone], input=NO_LANES, text=True, check=True)
        others = [*(o for o in tools.objects if not source_of(o)), alone]
        said = subprocess.run(["ld", "-r", *others, "-o", self.rest], capture_output=True, text=True)
        if said.returncode != 0:
            raise SystemExit(f"mutants: the tests' objects do not link: {said.stderr.strip()[:300]}")
        for source, built in self.modules.items():  # a copy: another build may go on beside this
            self.modules[source] = shutil.copy(built, folder / source.replace("/", "_").replace(".c", ".o"))
        self.original = self.link(folder / "tests", {})

    def link(self, program: Path, changed: dict[str, Path]) -> Path:
        modules = [str(changed.get(source, built)) for source, built in self.modules.items()]
        words = [*self.tools.link, str(self.rest), *modules, *self.tools.libraries, "-o", str(program)]
        said = subprocess.run(words, capture_output=True, text=True)
        if said.returncode != 0:
            raise SystemExit(f"mutants: does not link: {said.stderr.strip()[:300]}")
        return program

    def compile(self, source: str, text: str, folder: Path, more: tuple = ()) -> Path | None:
        """The object of this text in the place of the source; none where it does not compile."""
        folder.mkdir(exist_ok=True)
        copy, built = folder / Path(source).name, folder / "changed.o"
        copy.write_text(text, encoding="utf-8")
        words = [*self.tools.compiler_of(source), *more, "-c", str(copy), "-o", str(built)]
        said = subprocess.run(words, capture_output=True)
        return built if said.returncode == 0 else None

    def test_files(self, source: str) -> tuple[list[str], list[str]]:
        """Of a module: its own files of tests, and all others that may see it, cheap ones first."""
        own = files_of(source)
        others = [f for s in self.modules for f in files_of(s) if f not in own]
        return own, [*dict.fromkeys(others), *(f for f in FLIGHTS if f not in own)]

    def original_seconds(self, file: str) -> float:
        """How long the original takes; it has to pass."""
        with self.locks[file]:
            if file not in self.seconds:
                begin = time.monotonic()
                if self.fails(self.original, file, 1800.0):
                    raise SystemExit(f"mutants: {file} fails on the code as it is: mend that first")
                self.seconds[file] = time.monotonic() - begin
        return self.seconds[file]

    def fails(self, program: Path, file: str, limit_s: float) -> bool:
        """Whether a test of this file fails, dies or does not end. One that skips says nothing."""
        words = ["sh", "-c", f'ulimit -c 0; ulimit -t {limit_s:.0f}; exec "$0" "$1"', str(program), file]
        said = subprocess.run(words, capture_output=True, text=True, errors="replace")
        line = LINE.search(said.stdout)
        return line is None or int(line[2]) > 0

    def killed_by(self, program: Path, files: list[str]) -> str | None:
        for file in files:
            # An endless loop burns processor time; a busy machine does not.
            if self.fails(program, file, 5.0 + 10.0 * self.original_seconds(file)):
                return file
        return None


def source_of(built: str) -> str | None:
    """The file of src that an object is of; none for all others, and for lanes of it."""
    found = re.search(r"(?:^|/)(?<!lanes/)(?<!lanes_512/)(src/(?:firmware/)?\w+)\.o$", built)
    return f"{found[1]}.c" if found else None


def files_of(source: str) -> list[str]:
    """The test files of a module, by their names."""
    word = "app" if source.startswith("src/firmware/") else Path(source).stem
    names = sorted(f.name for f in Path("test").rglob("test_*.c"))
    return [n for n in names if (n == f"test_{word}.c" or n.startswith(f"test_{word}_")) and n not in (*FLIGHTS, *LEFT_OUT)]


@dataclass
class Verdict:
    what: str  # "does not compile", "same object", "killed" or "survives"
    by: str | None = None


def judge(bench: Bench, source: str, text: str, folder: Path) -> Verdict:
    """One mutant: a text in the place of a source's."""
    own, others = bench.test_files(source)
    try:
        trapped = bench.compile(source, text, folder, TRAPS)
        if not trapped:
            return Verdict("does not compile")
        program = bench.link(folder / "tests", {source: trapped})
        by = bench.killed_by(program, own)
        if not by and bench.compile(source, text, folder).read_bytes() == Path(bench.modules[source]).read_bytes():
            return Verdict("same object")
        by = by or bench.killed_by(program, others)
        return Verdict("killed", by) if by else Verdict("survives")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
