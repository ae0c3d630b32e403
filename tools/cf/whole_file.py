"""whole_file.py - a file that is whole, or clearly named as cut off. What was written is never lost.

It grows under a temporary name beside its place. keep() gives it its name; cut() gives it NAME.cut.SUFFIX, or
NAME.cut-2.SUFFIX where that is taken.
"""

import os
from pathlib import Path

from .errors import Failed, Refused

ALLOWED = "allowed is the name of a file in a folder that can be written"


class WholeFile:
    def __init__(self, option: str, path: Path) -> None:
        """Refused: it cannot be written. option is what the user typed it after."""
        self.path = path
        self._part = path.parent / f"{path.name}.{os.getpid()}.part"
        if path.is_dir():
            raise Refused(f"{option} {path}: is a folder; {ALLOWED}")
        try:
            self._file = open(self._part, "x", encoding="utf-8", newline="\n")
        except OSError as error:
            raise Refused(f"{option} {path}: {error.strerror}; {ALLOWED}") from None

    def write(self, text: str) -> None:
        self._file.write(text)

    def flush(self) -> None:
        self._file.flush()

    def keep(self) -> Path:
        """All is there: the file gets its name."""
        return self._end(self.path)

    def cut(self) -> Path:
        """Not all is there: what came so far gets a name that says so, and replaces no other file."""
        number, place = 1, self.path.with_name(f"{self.path.stem}.cut{self.path.suffix}")
        while place.exists():
            number += 1
            place = self.path.with_name(f"{self.path.stem}.cut-{number}{self.path.suffix}")
        return self._end(place)

    def drop(self) -> None:
        """Nothing was recorded: no file stays."""
        self._file.close()
        self._part.unlink(missing_ok=True)

    def _end(self, place: Path) -> Path:
        try:
            self._file.flush()
            os.fsync(self._file.fileno())
            self._file.close()
            os.replace(self._part, place)
        except OSError as error:
            raise Failed(f"{place}: {error.strerror}; what was written is in {self._part}") from None
        return place
