#!/usr/bin/env python3
"""page.py PAGE FILE - the desk's page as C (sim/desk/page.h), with the policy that only its own script and style run."""

import base64
import hashlib
import re
import sys
from pathlib import Path


def sums(html: str, tag: str) -> str:
    """What stands in each such element, as the sums that a browser compares."""
    found = re.findall(rf"<{tag}>(.*?)</{tag}>", html, re.DOTALL)
    if not found:
        raise SystemExit(f"page.py: no <{tag}> in the page")
    return " ".join(f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'" for text in found)


def main(page: Path, file: Path) -> None:
    html = page.read_text(encoding="utf-8")
    policy = (
        f"default-src 'none'; script-src {sums(html, 'script')}; style-src {sums(html, 'style')}; connect-src 'self'; "
        "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
    data = html.encode()
    rows = [", ".join(map(str, data[at : at + 24])) for at in range(0, len(data), 24)]
    lines = ['#include "desk/page.h"', "const unsigned char page_html[] = {", *(f"    {row}," for row in rows), "};"]
    lines += ["const size_t page_size = sizeof page_html;", f'const char page_policy[] = "{policy}";', ""]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
