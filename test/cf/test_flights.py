"""The learning flight and the test flight over the link, when all goes well or was asked for wrongly."""

import math
import sys
import time
import unittest
import unittest.mock

from fake_vehicle import LEARNED
from rig import FLAT, WEIGHTS, OverTheLink

import cf


class Identify(OverTheLink):
    def test_rows_that_tell_nothing_are_said_after_it_has_landed(self) -> None:
        self.refused(1, "rows came; 500 and more tell the motors' lag", "identify")
        self.assertEqual(self.flown(), ["take off"] + 25 * ["go to"] + ["land", "stop"])
        self.assertEqual(self.gaps_mm(), [200] + 12 * [225, 200])

    def test_a_library_that_is_missing_is_said_before_it_flies(self) -> None:
        with unittest.mock.patch.dict("sys.modules", {"scipy.optimize": None}), unittest.mock.patch.dict(vars(cf)):
            sys.modules.pop("cf.actuator", None)  # whoever imported it before, in both places
            vars(cf).pop("actuator", None)
            self.refused(1, "scipy.optimize is missing: make setup-cf", "identify")
        self.assertEqual(self.flown(), [])

    def test_what_the_app_commands_has_to_be_flown(self) -> None:
        self.vehicle.param["ceil.shadow"] = 1
        self.refused(1, "ceil.shadow is 1: the stock controller flies", "identify")
        self.assertEqual(self.flown(), [])


class Learn(OverTheLink):
    def test_it_flies_10_to_2_cm_and_stores_what_was_learned(self) -> None:
        ran = self.cf("learn")
        self.assertEqual(ran.status, 0, ran.err)
        self.assertEqual(self.flown(), ["take off"] + 6 * ["go to"] + ["land", "stop"])
        self.assertEqual(self.gaps_mm(), [200, 100, 80, 60, 40, 20])
        self.assertEqual(self.vehicle.stored, dict(zip(WEIGHTS, LEARNED)) | FLAT | {"ceil.wSum": 1002})
        self.assertEqual(list(self.vehicle.stored)[-1], "ceil.wSum")  # until then the vehicle refuses them as a set
        self.assertEqual([self.vehicle.param[name] for name in WEIGHTS], list(LEARNED))
        self.assertIn("ceil.w1 = 1.25\n", ran.out)
        self.assertGreater(self.vehicle.fed, 0)

    def test_it_learns_from_nothing_and_commits_on_the_floor(self) -> None:
        self.cf("learn")
        writes = [(name, value) for name, value in self.vehicle.writes if name in WEIGHTS or name == "ceil.commit"]
        self.assertEqual(writes[:8], [*zip(WEIGHTS, [1.0] + 6 * [0.0]), ("ceil.commit", 1)])
        self.assertEqual(writes[8:], [("ceil.commit", 2)])

    def test_each_gap_is_held_for_10_s(self) -> None:
        times_s = []
        self.vehicle.on_step = lambda v: times_s.append(v.time_s) if len(v.sent) - 1 == len(times_s) else None
        self.cf("learn")
        stays_s = [after - before for before, after in zip(times_s[1:7], times_s[2:8])]
        ways_s = [each[2] for each in self.went()]
        for stay_s, way_s in zip(stays_s, ways_s, strict=True):
            self.assertAlmostEqual(stay_s - way_s, 10.0, delta=0.3)

    def test_it_keeps_place_and_heading(self) -> None:
        self.cf("learn", "--hold", "1")
        for _, _, _, x_m, y_m, yaw_rad in self.went():
            self.assertEqual((x_m, y_m, yaw_rad), (0.1, -0.2, round(math.radians(30), 4)))

    def test_what_it_changed_for_the_flight_is_put_back(self) -> None:
        self.cf("learn")
        modes = [value for name, value in self.vehicle.writes if name == "ceil.mode"]
        self.assertEqual(modes, [2, 1])
        blind_s = [round(value, 3) for name, value in self.vehicle.writes if name == "ceil.blindMax"]
        self.assertGreater(blind_s[0], 20.0)  # 10 s at 4 cm and at 2 cm are longer than the app's 3 s
        self.assertEqual(blind_s[1:], [3.0])

    def test_it_stops_at_the_keep_out(self) -> None:
        self.vehicle.param["ceil.min"] = 0.05
        ran = self.cf("learn")
        self.assertEqual(self.gaps_mm(), [200, 100, 80, 60])
        self.assertIn("stops at 6 cm", ran.out)
        self.assertEqual(len(self.vehicle.stored), 15)

    def test_a_keep_out_beyond_the_flight_is_refused(self) -> None:
        self.vehicle.param["ceil.min"] = 0.2
        self.refused(2, "nothing to learn", "learn")

    def test_with_too_few_samples_the_old_weights_stay(self) -> None:
        old = [self.vehicle.param[name] for name in WEIGHTS]
        self.vehicle.on_step = lambda vehicle: setattr(vehicle, "taught", 0)
        ran = self.cf("learn")
        self.assertEqual(ran.status, 1)
        self.assertIn("0 samples taught the curve", ran.err)
        self.assertIn("weights are those of before", ran.out)
        for name, value in zip(WEIGHTS, old):
            self.assertAlmostEqual(self.vehicle.param[name], value, delta=1e-6)
        self.assertEqual(self.vehicle.stored, {})

    def test_weights_that_are_not_those_learned_are_not_stored(self) -> None:
        self.when(lambda v: v.commits == 2, lambda v: v.param.update({"ceil.w3": 0.75}))
        ran = self.cf("learn", "--hold", "2")
        self.assertEqual(ran.status, 1)
        self.assertIn("ceil.w3 is 0.75 after the commit, but -0.125 was learned", ran.err)
        self.assertEqual(self.vehicle.stored, {})

    def test_in_shadow_it_does_not_fly(self) -> None:
        self.vehicle.param["ceil.shadow"] = 1
        self.refused(1, "ceil.shadow is 1", "learn")
        self.assertEqual(self.flown(), [])

    def test_a_store_that_fails_half_way_says_what_is_left(self) -> None:
        self.vehicle.store_fails.add("ceil.w3")
        ran = self.cf("learn", "--hold", "2")
        self.assertEqual(ran.status, 1)
        self.assertIn("params store ceil.w3 ceil.w4 ceil.w5 ceil.w6 ceil.w7", ran.err)
        self.assertEqual([self.vehicle.param[name] for name in WEIGHTS], list(LEARNED))


class TestFlight(OverTheLink):
    def test_it_flies_20_9_5_and_3_cm(self) -> None:
        ran = self.cf("test-flight")
        self.assertEqual(ran.status, 0, ran.err)
        self.assertEqual(self.gaps_mm(), [200, 90, 50, 30])
        self.assertEqual(self.flown()[-2:], ["land", "stop"])
        self.assertEqual(self.vehicle.stored, {})

    def test_the_watchdog_is_fed_until_the_flight_is_over_and_no_more(self) -> None:
        fed_at_landing = []
        landing = lambda vehicle: bool(vehicle.sent) and vehicle.sent[-1][0] == "land"
        self.when(landing, lambda vehicle: (time.sleep(0.3), fed_at_landing.append(vehicle.fed)))
        ran = self.cf("test-flight", "--hold", "1")
        self.assertGreater(fed_at_landing[0], 1)
        self.assertIn("restart the Crazyflie", ran.out)
        fed = self.vehicle.fed
        time.sleep(0.5)
        self.assertEqual(self.vehicle.fed, fed)

    def test_gaps_can_be_chosen(self) -> None:
        self.cf("test-flight", "--gaps", "8,4.5", "--hold", "1")
        self.assertEqual(self.gaps_mm(), [200, 80, 45])

    def test_gaps_are_below_the_height_that_the_app_latched(self) -> None:
        self.vehicle.on_step = lambda v: v.wrong.update({"ceil.height": 1.47} if v.flying and v.gap_m < 0.5 else {})
        self.cf("test-flight", "--hold", "1")
        self.assertEqual([z for _, z, *_ in self.went()], [1.27, 1.38, 1.42, 1.44])

    def test_a_gap_nearer_than_the_keep_out_is_refused_on_the_floor(self) -> None:
        says = "--gaps 1.5: nearer than 2 cm (the keep-out, ceil.min); allowed are 2 to 20 cm"
        self.refused(2, says, "test-flight", "--gaps", "5,1.5")
        self.vehicle.param["ceil.min"] = 0.04
        self.refused(2, "--gaps 3: nearer than 4 cm", "test-flight")
        self.assertEqual(self.flown(), [])

    def test_in_shadow_the_stock_controller_is_kept_away_from_the_ceiling(self) -> None:
        self.vehicle.param["ceil.shadow"] = 1
        self.refused(2, "--gaps 5: nearer than 6 cm (with ceil.shadow 1", "test-flight")
        self.assertEqual(self.cf("test-flight", "--gaps", "9,6", "--hold", "1").status, 0)

    def test_options_out_of_range_are_refused(self) -> None:
        for words, says in (
            (("--gaps", "0.5"), "allowed are 1 to 20 cm"),
            (("--gaps", "9,far"), "allowed are 1 to 20 cm"),
            (("--hold", "0"), "allowed are 1 to 60 s"),
            (("--hold", "nan"), "allowed are 1 to 60 s"),
            (("--battery", "3"), "allowed are 3.5 to 4.2 V"),
            (("--log", "/no/such/folder/x.csv"), "allowed is the name of a file in a folder that can be written"),
            (("--log", "/"), "is a folder"),
        ):
            with self.subTest(words=words):
                self.refused(2, says, "test-flight", *words)
                self.assertEqual(self.flown(), [])


if __name__ == "__main__":
    unittest.main()
