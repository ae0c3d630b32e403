"""stop_key.py - the space bar stops the motors at once, whatever the program waits for meanwhile."""

import os
import select
import sys
import termios
import tty
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Event, Thread

from .craft import Craft
from .terminal import say

KEY = b" "


def _terminal() -> int | None:
    """The terminal that is typed on, if there is one. In the background it belongs to others."""
    try:
        terminal = sys.stdin.fileno()
        if not os.isatty(terminal):
            return None
    except (AttributeError, OSError, ValueError):  # closed, or none at all
        return None
    try:
        return terminal if os.tcgetpgrp(terminal) == os.getpgrp() else None
    except OSError:  # one without jobs
        return terminal


def _listen(terminal: int, leave: int, vehicle: Craft, pressed: Event) -> None:
    while True:
        ready, _, _ = select.select([terminal, leave], [], [])
        if leave in ready:
            return
        try:
            typed = os.read(terminal, 64)
        except OSError:  # it was closed, for which there is a signal
            return
        if KEY in typed:
            pressed.set()  # first: who sees the motors stand must know why
            vehicle.cut()
        if not typed or pressed.is_set():
            return


@contextmanager
def stop_key(vehicle: Craft) -> Iterator[Event]:
    """While it lasts, the key cuts the motors; the event says that it was pressed. Says so, or that no key does."""
    terminal, pressed = _terminal(), Event()
    if terminal is None:
        say("no key stops the motors: nobody types here (no terminal); Ctrl-C lands")
        yield pressed
        return
    say("SPACE stops the motors at once, wherever it is: it falls. Ctrl-C lands")
    before = termios.tcgetattr(terminal)
    wait, leave = os.pipe()
    thread = Thread(target=_listen, args=(terminal, wait, vehicle, pressed), daemon=True)
    try:
        tty.setcbreak(terminal)  # each key at once; Ctrl-C is what it was
        termios.tcflush(terminal, termios.TCIFLUSH)  # what was typed before is of before
        thread.start()
        yield pressed
    finally:
        os.write(leave, b".")
        if thread.ident:
            thread.join()
        os.close(wait)
        os.close(leave)
        with suppress(termios.error):  # it was closed
            termios.tcsetattr(terminal, termios.TCSADRAIN, before)
