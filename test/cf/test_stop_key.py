"""The key that stops the motors at once, on a terminal of the test's own."""

import os
import sys
import termios
import time
import unittest

from rig import OverTheLink


def near(gap_m: float):
    return lambda vehicle: vehicle.flying and vehicle.gap_m < gap_m + 1e-6


class StopKey(OverTheLink):
    def setUp(self) -> None:
        super().setUp()
        self.typist, terminal = os.openpty()
        self.addCleanup(os.close, self.typist)
        self.addCleanup(setattr, sys, "stdin", sys.stdin)
        sys.stdin = os.fdopen(terminal)
        self.addCleanup(sys.stdin.close)

    def type(self, keys: bytes) -> None:
        os.write(self.typist, keys)
        end_s = time.monotonic() + 0.5  # of the clock on the wall, while the vehicle's stands
        while "cut" not in self.flown() and time.monotonic() < end_s:
            time.sleep(0.01)

    def test_space_cuts_the_motors_at_once_and_nothing_is_flown_after_it(self) -> None:
        for command in ("test-flight", "learn"):
            with self.subTest(command=command):
                self.vehicle.sent.clear()
                self.vehicle.locked, self.vehicle.wrong = False, {}
                self.when(near(0.09), lambda _: self.type(b" "))
                ran = self.cf(command, "--hold", "1")
                self.assertEqual(ran.status, 1)
                self.assertIn("stopped by hand: the motors were cut", ran.err)
                self.assertIn("restart the Crazyflie", ran.out)
                self.assertEqual(self.flown()[-3:], 3 * ["cut"])  # nothing answers it: it is said three times
                self.assertNotIn("land", self.flown())
                self.assertAlmostEqual(self.vehicle.param["ceil.blindMax"], 3.0, delta=1e-6)

    def test_space_cuts_the_motors_while_it_takes_off_and_while_it_lands(self) -> None:
        for what in ("take off", "land"):
            with self.subTest(what=what):
                self.vehicle.locked, self.vehicle.wrong = False, {}
                self.vehicle.sent.clear()
                self.when(lambda v: bool(v.sent) and v.sent[-1][0] == what, lambda _: self.type(b" "))
                ran = self.cf("test-flight", "--hold", "1")
                self.assertEqual(ran.status, 1)
                self.assertEqual(self.flown()[-4:], [what] + 3 * ["cut"])

    def test_other_keys_and_what_was_typed_before_do_nothing(self) -> None:
        os.write(self.typist, b" ")
        self.when(near(0.09), lambda _: self.type(b"x\n"))
        self.assertEqual(self.cf("test-flight", "--hold", "1").status, 0)
        self.assertNotIn("cut", self.flown())

    def test_it_says_so_before_take_off_and_leaves_the_terminal_as_it_was(self) -> None:
        before = termios.tcgetattr(sys.stdin.fileno())
        ran = self.cf("test-flight", "--hold", "1")
        self.assertLess(ran.out.index("SPACE stops the motors at once"), ran.out.index("take-off to"))
        self.assertEqual(termios.tcgetattr(sys.stdin.fileno()), before)

    def test_without_a_terminal_it_says_that_no_key_does(self) -> None:
        with open(os.devnull) as nothing:
            sys.stdin, terminal = nothing, sys.stdin
            ran = self.cf("test-flight", "--hold", "1")
            sys.stdin = terminal
        self.assertEqual(ran.status, 0)
        self.assertLess(ran.out.index("no key stops the motors"), ran.out.index("take-off to"))


if __name__ == "__main__":
    unittest.main()
