"""terminal.py - lines that stay, and a line of progress that does not.

A terminal that is closed, or a pipe that nobody reads, must not end a flight: what cannot be written is dropped.
"""

import sys
from typing import TextIO

_open = False  # a progress line is on the terminal


def _write(stream: TextIO, text: str) -> None:
    try:
        stream.write(text)
        stream.flush()
    except (OSError, ValueError):  # nobody reads, or the stream is closed
        pass


def say(text: str) -> None:
    """A line that stays, on the standard output."""
    wipe()
    _write(sys.stdout, text + "\n")


def progress(text: str) -> None:
    """Replaces the line of progress. Nothing where nobody looks."""
    global _open
    if not sys.stderr.isatty():
        return
    _write(sys.stderr, f"\r\x1b[K{text}")
    _open = True


def wipe() -> None:
    """Takes the line of progress away."""
    global _open
    if _open:
        _write(sys.stderr, "\r\x1b[K")
    _open = False
