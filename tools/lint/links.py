#!/usr/bin/env python3
"""links.py - every link, anchor and path of the tree that a page names leads somewhere."""

import re
import sys
from pathlib import Path

ROOMS = ("src", "sim", "test", "tools")
PAGES = [Path("README.md"), *Path(".github").glob("*.md"), *(page for room in ROOMS for page in Path(room).rglob("*.md"))]
LINK = re.compile(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)")
PATH = re.compile(r"`((?:include|src|sim|test|tools)/[\w./*-]+)`")
FENCED = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)


def anchors(page: Path) -> set[str]:
    heads = re.findall(r"^#+ (.*)", FENCED.sub("", page.read_text(encoding="utf-8")), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.strip().lower()).replace(" ", "-") for head in heads}


def wrong(page: Path) -> list[str]:
    text = FENCED.sub("", page.read_text(encoding="utf-8"))
    links = [(page.parent / path if path else page, anchor) for path, anchor in LINK.findall(text)]
    bad = [f"{to} is not there" for to, _ in links if not to.exists()]
    within = [(to, anchor) for to, anchor in links if anchor and to.is_file()]
    bad += [f"{to} has no heading for #{anchor}" for to, anchor in within if anchor not in anchors(to)]
    bad += [f"{path} is not there" for path in PATH.findall(text) if not any(Path().glob(path))]
    return [f"{page}: {line}" for line in bad]


found = [line for page in PAGES for line in wrong(page)]
print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
sys.exit(1 if found else 0)
