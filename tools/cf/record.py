"""record.py - log packets to a CSV file with Crazyflie names.

A row holds at most one packet of each block, all from within one period; its timestamp (ms) is that of the first.
What did not come is nan.
"""

import math
from pathlib import Path
from threading import Lock

from .blocks import Block
from .whole_file import WholeFile

WRAP_MS = 1 << 24  # the link's time stamps have 24 bits


def text(value: float) -> str:
    return f"{value:.9g}" if isinstance(value, float) else str(value)


class Record:
    def __init__(self, option: str, path: Path, blocks: list[Block]) -> None:
        """Refused: the file cannot be written."""
        self._names = list(dict.fromkeys(name for block in blocks for name in block.types))
        self._period_ms = min(block.period_ms for block in blocks)
        self._file = WholeFile(option, path)
        self._file.write(",".join(["timestamp", *self._names]) + "\n")
        self._lock = Lock()
        self._row: dict[str, float] = {}
        self._blocks: set[str] = set()
        self._row_ms, self._last_ms, self._turns, self._flushed_ms = 0, 0, 0, 0
        self.rows = 0
        self.trouble = ""  # why nothing can be written any more; "": it can

    def take(self, block: str, stamp_ms: int, values: dict[str, float]) -> None:
        """A packet. Called by the link's thread; never raises."""
        with self._lock:
            if stamp_ms < self._last_ms - WRAP_MS // 2:
                self._turns += 1
            self._last_ms = stamp_ms
            at_ms = stamp_ms + self._turns * WRAP_MS
            if self._blocks and (block in self._blocks or at_ms - self._row_ms >= self._period_ms):
                self._write()
            if not self._blocks:
                self._row_ms = at_ms
            self._blocks.add(block)
            self._row.update(values)

    def end(self, whole: bool) -> str:
        """The last row and the file's name. Returns the name, or "" where no row came."""
        with self._lock:
            if self._blocks:
                self._write()
            if self.rows == 0:
                self._file.drop()
                return ""
            return str(self._file.keep() if whole and not self.trouble else self._file.cut())

    def _write(self) -> None:
        row = [text(self._row.get(name, math.nan)) for name in self._names]
        try:
            self._file.write(",".join([str(self._row_ms), *row]) + "\n")
            self.rows += 1
            if self._row_ms - self._flushed_ms >= 1000:
                self._file.flush()
                self._flushed_ms = self._row_ms
        except OSError as error:  # a full disk must not end a flight
            self.trouble = self.trouble or str(error.strerror)
        self._row.clear()
        self._blocks.clear()
