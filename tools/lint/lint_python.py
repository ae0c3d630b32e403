#!/usr/bin/env python3
"""lint_python.py FILE... - the rules of the house for Python: short files, short functions, short lines."""

import ast
import sys
from pathlib import Path

FILE_LINES, FUNCTION_LINES, COLUMNS = 250, 40, 125


def complaints(file: Path) -> list[str]:
    text = file.read_text(encoding="utf-8")
    lines = text.splitlines()
    found = [f"{file}:{i}: {len(line)} columns" for i, line in enumerate(lines, 1) if len(line) > COLUMNS]
    if len(lines) > FILE_LINES:
        found.append(f"{file}: {len(lines)} lines: it holds two things")
    tree = ast.parse(text, str(file))
    if lines and not ast.get_docstring(tree):
        found.append(f"{file}: does not say what it is")
    for node in ast.walk(tree):
        if not isinstance(node, ast.FunctionDef):
            continue
        if node.end_lineno - node.lineno >= FUNCTION_LINES:
            found.append(f"{file}:{node.lineno}: {node.name} has {node.end_lineno - node.lineno + 1} lines")
    return found


def main(files: list[str]) -> int:
    found = [each for file in files for each in complaints(Path(file))]
    print("\n".join(found), file=sys.stderr) if found else None
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
