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
    except (AttributeError, OSError, ValueError):  # stdin is closed, or there is none
        return None
    try:
        return terminal if os.tcgetpgrp(terminal) == os.getpgrp() else None
    except OSError:  # a terminal without job control
        return terminal


def _listen(terminal: int, leave: int, vehicle: Craft, pressed: Event) -> None:
    while True:
        ready, _, _ = select.select([terminal, leave], [], [])
        if leave in ready:
            return
        try:
            typed = os.read(terminal, 64)
        except OSError:  # closed, which sends a signal
            return
        if KEY in typed:
            pressed.set()  # before the cut: whoever sees the motors stop must know why
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
        tty.setcbreak(terminal)  # each key at once; Ctrl-C works as before
        termios.tcflush(terminal, termios.TCIFLUSH)  # drops what was typed before
        thread.start()
        yield pressed
    finally:
        os.write(leave, b".")
        if thread.ident:
            thread.join()
        os.close(wait)
        os.close(leave)
        with suppress(termios.error):  # the terminal was closed
            termios.tcsetattr(terminal, termios.TCSADRAIN, before)
