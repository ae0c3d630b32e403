"""run.py - what the recipes share: the build's programs, lines as they are typed, gnuplot, and who looks on."""

import os
import re
import subprocess
import sys
from pathlib import Path

OUT = Path(os.environ.get("O") or "out")  # the folder of all that is made
DATA = os.environ.get("DATA", "")  # the folder of recorded flights
PROGRAMS = ("fly", "gap", "learn", "effectiveness", "bench", "exam", "slot", "bound")
HERE = Path(__file__).resolve().parent
FLY_COLUMNS = "--columns tools/columns/fly.toml"  # of fly's own logs


class Failed(Exception):
    """A recipe cannot be made."""


class Left(Exception):
    """What is there stays as it is: something that this recipe needs is not at hand."""


def program(*words: object, may_end_with: tuple[int, ...] = (0,), **options) -> str:
    """What it says on standard output. One of the build is named by its word alone."""
    line = [str(OUT / words[0]) if words[0] in PROGRAMS else str(words[0]), *map(str, words[1:])]
    done = subprocess.run(line, stdout=subprocess.PIPE, text=True, check=False, **options)
    if done.returncode not in may_end_with:
        raise Failed(f"{line[0]} ends with {done.returncode}")
    return done.stdout


def typed(line: str) -> None:
    """Shows a line of the shell, and what comes of it: what is shown is what is typed."""
    print(f"$ {line}\n{program('sh', '-euc', line)}", end="")


def progress(what: str = "") -> None:
    if sys.stderr.isatty():
        print(f"\r  {what:<60}" if what else f"\r{'':62}\r", end="", file=sys.stderr, flush=True)


def folder(name: str) -> Path:
    """An empty one under OUT."""
    program("rm", "-rf", OUT / name)
    (OUT / name).mkdir(parents=True)
    return OUT / name


def vehicle_under_ceiling(path: Path) -> None:
    """What the workflow is given in the examples: it knows where the ceiling is, and nothing of what it does."""
    path.write_text("ceiling_m = 0.5 # of the simulated room\n" + Path("sim/vehicle/vehicles/cf21_legacy.toml").read_text())


def gnuplot(script: str, where: Path, **values: object) -> str:
    """Draws tools/doc/SCRIPT.gp in a folder, with these values as its variables."""
    text = ";".join(f"{name}='{value}'" if isinstance(value, str) else f"{name}={value}" for name, value in values.items())
    env = {**os.environ, "GNUPLOT_LIB": str(HERE)}
    return program("gnuplot", *(["-e", text] if text else []), HERE / f"{script}.gp", cwd=where, env=env)


def pictures(where: Path) -> None:
    """Says which were drawn; not in a document."""
    print("\npictures:", *sorted(where.glob("*.png")), sep="\n  ")


NO_PICTURES = r"\npictures:(\n  .*)*\n"


def letters(drawn: str) -> str:
    """A picture in letters, as it stands in a text."""
    return "\n".join(line.rstrip() for line in drawn.splitlines()).lstrip("\n")


def weights(text: str) -> str:
    """The seven weights that fly prints, as curves.gp takes them."""
    return " ".join(re.findall(r"^ *ceil\.w[1-7] +(\S+)", text, re.M))
