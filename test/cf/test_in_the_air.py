"""What keeps a flight on the floor, and what brings it down."""

import contextlib
import io
import math
import os
import signal
import unittest

from fake_link import FakeLink
from fake_vehicle import LOCKED
from rig import WEIGHTS, OverTheLink, main


def near(gap_m: float):
    return lambda vehicle: vehicle.flying and vehicle.gap_m < gap_m + 0.001


class Refusals(OverTheLink):
    def test_it_does_not_take_off_when_something_speaks_against_it(self) -> None:
        for wrong, says in (
            ({"ceil.decks": 1}, "missing: multiranger deck"),
            ({"ceil.decks": 0}, "missing: flow deck v2, multiranger deck"),
            ({"guard.notFlyable": 1}, "not flyable: at rest the accelerometer does not point up"),
            ({"pm.vbat": 3.6}, "the battery has 3.60 V; allowed is 3.80 V and more"),
            ({"pm.state": 1}, "the battery is being charged"),
            ({"range.up": 32767}, "the ceiling is not seen"),
            ({"range.up": 0}, "the ceiling is not seen"),
            ({"range.up": 450}, "the ceiling is 0.45 m above; allowed are 0.6 to 3 m"),
            ({"range.up": 3500}, "the ceiling is 3.50 m above"),
            ({"stateEstimate.z": 0.7}, "the estimator's height on the floor is 0.70 m"),
            ({"stateEstimate.z": math.nan}, "the estimator's height on the floor is nan m"),
            ({"supervisor.info": LOCKED}, "the Crazyflie is locked: restart it"),
            ({"supervisor.info": 1 << 5}, "lies on its side"),
            ({"supervisor.info": 0}, "cannot fly"),
        ):
            with self.subTest(wrong=wrong):
                self.vehicle.wrong = wrong
                for command in ("learn", "test-flight", "identify"):
                    self.refused(1, says, command)
                self.assertEqual((self.flown(), self.vehicle.fed), ([], 0))

    def test_it_does_not_fly_another_controller(self) -> None:
        self.vehicle.param["stabilizer.controller"] = 1
        self.refused(1, "stabilizer.controller is 1: the app does not fly; allowed is 6", "test-flight")

    def test_without_the_app_it_says_flash_the_app_first(self) -> None:
        v = self.vehicle
        v.param_rows = tuple(row for row in v.param_rows if not row.name.startswith("ceil."))
        for command in ("learn", "test-flight"):
            self.refused(1, "ceil.w1 is not there: this Crazyflie does not run the app; flash the app first", command)
        self.refused(1, "ceil.min: this Crazyflie does not run the app; flash the app first", "params", "get", "ceil.min")


class InTheAir(OverTheLink):
    def lands(self, says: str) -> None:
        ran = self.cf("test-flight")
        self.assertEqual(ran.status, 1)
        self.assertIn(says, ran.err)
        self.assertEqual(self.flown()[-2:], ["land", "stop"])
        self.assertEqual(self.vehicle.z_m, 0.0)
        self.assertNotIn(30, self.gaps_mm())
        self.assertAlmostEqual(self.vehicle.param["ceil.blindMax"], 3.0, delta=1e-6)

    def test_it_lands_when_something_goes_wrong(self) -> None:
        for wrong, says in (
            ({"range.up": 32767}, "the range sensor is lost"),
            ({"ceil.known": 0}, "the ceiling is not seen any more"),
            ({"guard.action": 2, "guard.now": 1 << 6}, "the app does its own (retreat): the range sensor is lost"),
            ({"guard.action": 3, "guard.latched": 1 << 5}, "(hand over): tilted beyond 60 degrees"),
            ({"ceil.height": 1.38}, "the ceiling's height went from 1.500 to 1.380 m"),
            ({"pm.state": 3, "pm.vbat": 3.1}, "the battery is low (3.10 V)"),
            ({"supervisor.info": 0b11010 | 1 << 5}, "has crashed"),
        ):
            with self.subTest(wrong=wrong):
                self.setUp()
                self.when(near(0.05), lambda vehicle: vehicle.wrong.update(wrong))
                self.lands(says)

    def test_a_ceiling_that_is_never_seen_from_the_air_is_not_flown_to(self) -> None:
        self.vehicle.wrong = {"ceil.known": 0}
        ran = self.cf("test-flight")
        self.assertEqual(ran.status, 1)
        self.assertIn("the ceiling is not seen (ceil.known)", ran.err)
        self.assertEqual(self.flown(), ["take off", "land", "stop"])

    def test_a_range_sample_that_misses_now_and_then_is_no_reason_to_land(self) -> None:
        def step(vehicle) -> None:
            vehicle.wrong = {"range.up": 32767} if round(10 * vehicle.time_s) % 20 < 5 and vehicle.flying else {}

        self.vehicle.on_step = step
        self.assertEqual(self.cf("test-flight").status, 0)

    def test_ctrl_c_lands_and_puts_the_weights_back(self) -> None:
        old = [self.vehicle.param[name] for name in WEIGHTS]
        for kind in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(kind=kind):
                self.vehicle.sent.clear()
                self.when(near(0.06), lambda _: os.kill(os.getpid(), kind))
                ran = self.cf("learn")
                self.assertEqual(ran.status, 130)
                self.assertEqual(self.flown()[-2:], ["land", "stop"])
                self.assertEqual(self.gaps_mm()[-1], 60)
                self.assertEqual(self.vehicle.param["ceil.mode"], 1)
                for name, value in zip(WEIGHTS, old):
                    self.assertAlmostEqual(self.vehicle.param[name], value, delta=1e-6)

    def test_ctrl_c_while_it_lands_does_not_stop_the_landing(self) -> None:
        landing = lambda vehicle: bool(vehicle.sent) and vehicle.sent[-1][0] == "land"
        self.when(landing, lambda _: os.kill(os.getpid(), signal.SIGINT))
        ran = self.cf("test-flight")
        self.assertEqual(ran.status, 0)
        self.assertEqual(self.vehicle.z_m, 0.0)

    def test_a_pipe_that_nobody_reads_does_not_end_a_flight(self) -> None:
        class Closed(io.StringIO):
            def write(self, text: str) -> int:
                raise BrokenPipeError

        with contextlib.redirect_stdout(Closed()), contextlib.redirect_stderr(Closed()):
            self.assertEqual(main(["--uri", "fake://cf", "test-flight", "--hold", "1"]), 0)
        self.assertEqual(self.flown(), ["take off"] + 4 * ["go to"] + ["land", "stop"])

    def test_a_lost_link_is_told_and_the_log_is_named_as_cut(self) -> None:
        says = ("the app lands it where it is", "while it was told to land: look where it is")
        for told in (True, False):  # by the driver, or by the packets that do not come
            with self.subTest(told=told):
                self.setUp()
                self.when(near(0.05), lambda _: FakeLink.open.lose(told))
                ran = self.cf("test-flight", "--log", self.folder / "flight.csv")
                self.assertEqual(ran.status, 1)
                self.assertIn("the link is lost", ran.out + ran.err)
                self.assertIn(says[0] if told else says[1], ran.err)
                self.assertEqual([file.name for file in self.folder.iterdir()], ["flight.cut.csv"])
                self.assertGreater(len((self.folder / "flight.cut.csv").read_text().splitlines()), 100)
                fed = self.vehicle.fed
                self.assertGreater(fed, 0)

    def test_when_only_the_way_back_is_lost_it_is_told_to_land_and_fed_until_it_is_down(self) -> None:
        self.when(near(0.05), lambda _: setattr(FakeLink.open, "mute", True))
        ran = self.cf("test-flight")
        self.assertEqual(ran.status, 1)
        self.assertEqual(self.flown()[-2:], ["land", "stop"])
        self.assertEqual(self.vehicle.z_m, 0.0)

    def test_what_the_app_says_on_its_console_is_passed_on(self) -> None:
        self.when(near(0.05), lambda _: [FakeLink.open.tell(part) for part in ("CEIL: Guard: ", "reasons 0x40\n")])
        ran = self.cf("test-flight")
        self.assertIn("console: CEIL: Guard: reasons 0x40\n", ran.out)

    def test_the_whole_flight_is_logged(self) -> None:
        file = self.folder / "flight.csv"
        self.assertEqual(self.cf("test-flight", "--log", file).status, 0)
        head, *rows = file.read_text().splitlines()
        self.assertTrue(head.startswith("timestamp,"))
        self.assertEqual([each.name for each in self.folder.iterdir()], ["flight.csv"])
        column = head.split(",").index("stateEstimate.z")
        highest = max(float(row.split(",")[column]) for row in rows)
        self.assertAlmostEqual(highest, 1.47, delta=0.001)


if __name__ == "__main__":
    unittest.main()
