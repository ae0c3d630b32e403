"""recipes.py - what stands generated in the tree's documents, and how it is made.

To add a block: a row here, and `<!-- NAME -->` and `<!-- end -->` in a README.md, each on a line of its own. A picture's
row names the .svg that it draws. What a recipe prints is the block, or the picture.
"""

import re
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import before
import bound
import by_height
import channel
import demo
import desk
import flights
import gap
import laws
import passing
import robust
import run
from run import OUT, program, typed


class Recipe(NamedTuple):
    make: Callable[[], None]
    picture: str = ""  # the .svg that gets the output; "": the block of that name
    markdown: bool = False  # markdown: not shown as typed
    data: bool = False  # it needs recorded flights
    leaves_out: str = ""  # what differs between runs or machines


def says(*words: object, **options) -> Callable[[], None]:
    return lambda: print(program(*words, **options), end="")


def closest() -> None:
    for kp, kd in ((1, 5), (2, 8)):
        nearest = """awk '$1 == "gap" && $NF == 0 { mm = $2 } END { print mm " mm" }'"""
        typed(f"{OUT}/fly closest-hover --set indiPos.kpz={kp} --set indiPos.kdz={kd} | {nearest}")


def height() -> None:
    for scenario, table in (("bias-hover", "bias"), ("hand-held", "ceiling_height")):
        typed(f"{OUT}/fly {scenario} | sed -n '/^{table}/,/^contacts/{{/^contacts/!p}}'")


def noise() -> None:
    """The levels' numbers, as fly --list has them."""
    said = program("fly", "--list")
    print(said[said.index("\nnoise\n") + 1:], end="")


def identify() -> None:
    typed(f"{OUT}/fly inner-loop --log {OUT}/shaken.csv --log-rate 500 >{OUT}/shaken.txt")
    for options in ("--lag 0.08 --delay 0.006", "--lag 0.08"):
        typed(f"{OUT}/effectiveness {OUT}/shaken.csv {options}")
        print()
    typed(f'{OUT}/effectiveness "$DATA/inner_loop_id/data_1901.csv" --as-stock')


def image() -> None:
    size = OUT / "firmware/size"
    if not size.is_file():
        raise run.Left("make firmware was not run")
    print(size.read_text(), end="")


def target() -> None:
    said = program("test/pil/pil.sh")
    if said.startswith("skipped"):
        raise run.Left(said.strip())
    print(said, end="")


def counted() -> None:
    python = OUT / "cf/bin/python"
    if not python.is_file():
        raise run.Left("make setup-cf was not run")
    print(program("env", "OPENBLAS_NUM_THREADS=1", "PYTHONDONTWRITEBYTECODE=1", python, "test/cf/count_identify.py"), end="")


def outside() -> None:
    """Only the table: what each set was stands in out/flown_outside."""
    said = program("make", "outside", "SEED=127301", "SETS=40")
    if said.startswith("skipped"):
        raise run.Left(said.strip())
    print(said[said.index("\nseed ") + 1:], end="")


def faults() -> None:
    """Those that are not promised."""
    table = ("env", "FAULTS_TABLE=1", "TEST_LONG=1", OUT / "release/bin/tests", "faults_of_the_list")
    said = program(*table, may_end_with=(0, 1))  # 1: a promise was not kept, which the table says
    if "died (status" in said:
        raise run.Failed(said.splitlines()[0])
    left_out = re.compile(" 100\\.0 |passed|FAILED|, want|promised are")
    print(*(line for line in said.splitlines() if not left_out.search(line)), sep="\n")


def picture_of_flight() -> None:
    out = run.folder("pictures")
    for who in ("indi", "indi-theory"):
        flown = "--thesis-law --integrator rk4 --seed 1 --log".split()
        program("fly", "close-flight", "--controller", who, *flown, out / f"{who}.csv")
    print(run.gnuplot("picture_flight", out), end="")


def picture_of_diagnosis() -> None:
    if not (OUT / "demo/gap/ceiling.csv").is_file():
        raise run.Left("make demo was not run")
    print(run.gnuplot("picture_diagnosis", OUT / "demo/gap"), end="")


RECIPES = {
    "params": Recipe(says("fly", "--params=markdown"), markdown=True),
    "effects": Recipe(says("fly", "--effects"), markdown=True),
    "logs": Recipe(says("fly", "--logs"), markdown=True),
    "counted": Recipe(counted),
    "image": Recipe(image),
    "pil": Recipe(target),
    "hop": Recipe(lambda: print("```python", Path("tools/cf/hop.py").read_text() + "```", sep="\n"), markdown=True),
    "cf": Recipe(lambda: typed("tools/cf.py test-flight --dry-run")),
    "demo": Recipe(demo.demo, data=True, leaves_out=rf"{re.escape(run.DATA)}/\S*/|{run.NO_PICTURES}"),
    "gap": Recipe(gap.example, data=True, leaves_out=r", \d+ x real time"),
    "recorded": Recipe(gap.recorded, data=True),
    "seeds": Recipe(gap.other_seeds),
    "mass-flights": Recipe(gap.mass_flights),
    "cable": Recipe(gap.added_effect),
    "bench": Recipe(says("bench")),
    "bench-before": Recipe(before.before),
    "desk": Recipe(desk.load),
    "closest": Recipe(closest),
    "noise": Recipe(noise),
    "flights": Recipe(flights.flights, leaves_out=run.NO_PICTURES),
    "identify": Recipe(identify, data=True),
    "laws": Recipe(laws.laws),
    "touches": Recipe(flights.touches),
    "bound": Recipe(bound.bound),
    "by-height": Recipe(by_height.by_height),
    "passing": Recipe(passing.passing),
    "channel": Recipe(channel.channel),
    "pushes": Recipe(passing.pushes),
    "robust": Recipe(robust.robust),
    "exam": Recipe(says("exam", 226001, 200)),
    "users": Recipe(says("exam", "users", 234001, 320)),
    "outside": Recipe(outside),
    "slot": Recipe(says("slot", run.DATA), data=True),
    "c3": Recipe(height),
    "faults": Recipe(faults),
    "picture-flight": Recipe(picture_of_flight, picture=".doc/flight.svg"),
    "picture-diagnosis": Recipe(picture_of_diagnosis, picture=".doc/diagnosis.svg"),
    "picture-rooms": Recipe(says("python3", "tools/lint/arrows.py", "--svg"), picture=".doc/rooms.svg"),
}
