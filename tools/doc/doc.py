#!/usr/bin/env python3
"""doc.py - what stands generated in the tree's documents.

  doc.py write [WORD...]  makes it anew: all, or what is named so, or else whose name has the word
  doc.py show NAME...     prints what these make, and writes no document
  doc.py check            says what has no recipe, and which recipe has no place

A block stands between the lines `<!-- NAME -->` and `<!-- end -->` of a README.md or LOGS.md, in whichever folder; a
picture is an .svg of this tree that one of them shows. Each is written only when its recipe has come to its end. O is the
folder of what is built, DATA that of recorded flights.
"""

import contextlib
import io
import os
import re
import sys
import time
from pathlib import Path

import run
from recipes import RECIPES, Recipe

MARK = re.compile(r"^<!-- ([a-z0-9-]+) -->\n", re.M)
SHOWN = re.compile(r"(?:\]\(|src=\")([^)\" :]+\.svg)")


class Refused(Exception):
    """The documents and the recipes do not fit."""


def documents() -> list[Path]:
    rooms = [p for top in ("include", "sim", "src", "test", "tools") for p in Path(top).rglob("*.md")]
    return [Path("README.md"), *sorted(p for p in rooms if p.name in ("README.md", "LOGS.md"))]


def blocks(page: Path, text: str) -> dict[str, tuple[int, int]]:
    """Where each block of a document begins and ends."""
    marks = list(MARK.finditer(text))
    found = {begin[1]: (begin.end(), end.start()) for begin, end in zip(marks[::2], marks[1::2])}
    order = " ".join(mark[1] for mark in marks)
    if not re.fullmatch(r"(?:(?!end\b)\S+ end ?)*", order):
        raise Refused(f"{page}: not every block has its end: {order}")
    if 2 * len(found) != len(marks):
        raise Refused(f"{page}: a block stands here twice: {order}")
    return found


def places(recipes: dict[str, Recipe]) -> dict[str, Path]:
    """Where each recipe's text goes; refuses what has no recipe, and a recipe without a place or with two."""
    found: dict[str, Path] = {}
    drawn = {recipe.picture: name for name, recipe in recipes.items() if recipe.picture}
    for page in documents():
        text = page.read_text()
        for name in blocks(page, text):
            if name not in recipes or recipes[name].picture:
                raise Refused(f"{page}: {name} has no recipe")
            if name in found:
                raise Refused(f"{name} stands twice, in {found[name]} and in {page}")
            found[name] = page
        for picture in (os.path.normpath(page.parent / shown) for shown in SHOWN.findall(text)):
            if picture not in drawn:
                raise Refused(f"{page}: the picture {picture} has no recipe")
            found[drawn[picture]] = Path(picture)
    if missing := [name for name in recipes if name not in found]:
        raise Refused(f"recipes without a place: {', '.join(missing)}")
    return found


def made(recipe: Recipe) -> str:
    """What the recipe prints, as it stands in the document."""
    if recipe.data and not run.DATA:
        raise run.Left("it needs recorded flights, DATA=DIR")
    with contextlib.redirect_stdout(io.StringIO()) as said:
        recipe.make()
    text = re.sub(recipe.leaves_out, "", said.getvalue()) if recipe.leaves_out else said.getvalue()
    if not text.strip():
        raise run.Failed("it says nothing")
    return text if recipe.picture or recipe.markdown else f"```\n{text}```\n"


def put(name: str, place: Path, text: str) -> str:
    """Writes it, into what is there by now: its recipe may have taken an hour."""
    old = place.read_text() if place.exists() else ""
    begin, end = blocks(place, old)[name] if place.suffix == ".md" else (0, len(old))
    new = old[:begin] + text + old[end:]
    if new == old:
        return "as it was"
    place.with_suffix(".new").write_text(new)
    place.with_suffix(".new").replace(place)
    return "anew"


def write(recipes: dict[str, Recipe], words: list[str]) -> int:
    where = places(recipes)
    names = list(recipes) if not words else []
    for word in words:
        names += [word] if word in recipes else [name for name in recipes if word in name]
    if not names:
        raise Refused(f"no recipe's name has {' or '.join(words)}; there are {', '.join(recipes)}")
    failed = False
    for i, name in enumerate(names, 1):
        print(f"[{i}/{len(names)}] {name}, {where[name]}", flush=True)
        began = time.monotonic()
        try:
            what = put(name, where[name], made(recipes[name]))
        except run.Left as why:
            what = f"left as it is: {why}"
        except (run.Failed, Refused, OSError, LookupError, ValueError) as why:
            what, failed = f"FAILED, left as it is: {why}", True
        print(f"        {time.monotonic() - began:.1f} s, {what}", flush=True)
    return 1 if failed else 0


def show(recipes: dict[str, Recipe], names: list[str]) -> int:
    for i, name in enumerate(names):
        print(end="\n" if i > 0 else "")
        recipes[name].make()
    return 0


def main(words: list[str], recipes: dict[str, Recipe]) -> int:
    try:
        match words:
            case ["write", *some]:
                return write(recipes, some)
            case ["show", *names] if names and set(names) <= set(recipes):
                return show(recipes, names)
            case ["check"]:
                return 0 if places(recipes) else 1
    except (Refused, run.Failed, run.Left) as why:
        print(f"doc: {why}", file=sys.stderr)
        return 1
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:], RECIPES))
