"""terminal.py - lines that stay, and a line of progress that does not."""

import sys

_open = False  # a line of progress stands on the terminal


def say(text: str) -> None:
    """A line that stays, on the standard output."""
    wipe()
    print(text, flush=True)


def progress(text: str) -> None:
    """Replaces the line of progress. Nothing where nobody looks."""
    global _open
    if not sys.stderr.isatty():
        return
    sys.stderr.write(f"\r\x1b[K{text}")
    sys.stderr.flush()
    _open = True


def wipe() -> None:
    """Takes the line of progress away."""
    global _open
    if _open:
        sys.stderr.write("\r\x1b[K")
        sys.stderr.flush()
    _open = False
