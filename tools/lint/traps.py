"""Every trap of test/seeded changes the file that it names: one that changes nothing is no trap any more."""

import re
import subprocess
import sys
from pathlib import Path


def stale(trap: Path) -> str | None:
    named = re.search(r"^# file: (\S+)$", trap.read_text(), re.MULTILINE)
    if named is None:
        return "names no file"
    file = Path(named[1])
    if not file.exists():
        return f"{file} is not there"
    done = subprocess.run(["sed", "-f", trap, file], capture_output=True, check=False)
    if done.returncode != 0:
        return done.stderr.decode().strip()
    return f"leaves {file} as it is" if done.stdout == file.read_bytes() else None


bad = [f"{trap}: {why}" for trap in sorted(Path("test/seeded").glob("*.sed")) if (why := stale(trap))]
print("\n".join(bad), end="\n" if bad else "")
sys.exit(bool(bad))
