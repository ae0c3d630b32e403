#!/usr/bin/env python3
"""rules.py - the rules of the house that no tool knows: the size of files and functions, and tests that are named exist."""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

C_LINES, PYTHON_LINES, FUNCTION_LINES, COLUMNS = 400, 250, 40, 125
TOPS = ("include", "src", "sim", "test", "tools")
READING_RULE = re.compile(r"^\|.*\| `([a-z0-9_]+)` \|$", re.M)
KEY_FILES = ("sim/vehicle/model_file.c", "sim/vehicle/frame_file.c", "sim/pilots/controller_file.c")
KEYS = re.compile(r"const char \*const (?:keys|ROOT_KEYS)\[\] = \{(.*?)\}", re.S)
OF_CONSTANTS = re.compile(r"^// test: (.*)$", re.M)


def files(*suffixes: str) -> list[Path]:
    return sorted(p for top in TOPS for p in Path(top).rglob("*") if p.suffix in suffixes)


def of_c(file: Path, lines: list[str]) -> Iterator[str]:
    if len(lines) > C_LINES:
        yield f"{file}: {len(lines)} lines: it holds two things"
    began, head = 0, False
    for i, line in enumerate(lines, 1):
        if re.match(r"(TEST\(|[a-z]).*\) \{$", line) or head and re.match(r"    .*\) \{$", line):
            began, name = i, line
        head = re.match(r"[a-z][^;]*[,(]$", line) is not None
        if line == "}" and began:
            if i - began + 1 > FUNCTION_LINES:
                yield f"{file}:{began}: {i - began + 1} lines: {name}"
            began = 0


def of_python(file: Path, lines: list[str]) -> Iterator[str]:
    for i, line in enumerate(lines, 1):
        if len(line) > COLUMNS:
            yield f"{file}:{i}: {len(line)} columns"
    if len(lines) > PYTHON_LINES:
        yield f"{file}: {len(lines)} lines: it holds two things"
    tree = ast.parse("\n".join(lines), str(file))
    if lines and not ast.get_docstring(tree):
        yield f"{file}: does not say what it is"
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and node.end_lineno - node.lineno >= FUNCTION_LINES:
            yield f"{file}:{node.lineno}: {node.name} has {node.end_lineno - node.lineno + 1} lines"


def of_tests() -> Iterator[str]:
    tests = [line for file in files(".c") if file.name.startswith("test_") for line in file.read_text().splitlines()]
    named = [(Path("src/README.md"), READING_RULE)]
    named += [(file, OF_CONSTANTS) for file in files(".c", ".h") if file.parts[0] in ("src", "include")]
    for file, rule in named:
        for test in rule.findall(file.read_text(encoding="utf-8")):
            if not any(line.startswith(f"TEST({test})") for line in tests):
                yield f"{file} names the test {test}, which does not exist"


def of_vehicle_files() -> Iterator[str]:
    page = Path("sim/vehicle/README.md")
    said = set(re.findall(r"`\[*(\w+)\]*`", page.read_text(encoding="utf-8")))
    for name in KEY_FILES:
        lists = KEYS.findall(Path(name).read_text(encoding="utf-8"))
        keys = [key for one in lists for key in re.findall(r'"(\w+)"', one)]
        if not keys:
            yield f"{name}: no list of keys"
        for key in keys:
            if key not in said:
                yield f"{page} says nothing of the key {key} of {name}"


def complaints() -> Iterator[str]:
    for suffixes, rule in (((".c", ".h", ".cpp", ".hpp"), of_c), ((".py",), of_python)):
        for file in files(*suffixes):
            yield from rule(file, file.read_text(encoding="utf-8").splitlines())
    yield from of_tests()
    yield from of_vehicle_files()


if __name__ == "__main__":
    found = list(complaints())
    print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
    sys.exit(1 if found else 0)
