"""The stock library flies what is at the desk: parameters, logs, its own commanders."""

import os
import time
import unittest

from desk_rig import AtTheDesk, cflib

try:
    from cflib.crazyflie.mem import MemoryElement, Poly4D
    from cflib.positioning.motion_commander import MotionCommander
    from cflib.positioning.position_hl_commander import PositionHlCommander
    from cflib.utils.multiranger import Multiranger
except ImportError:
    pass  # skipped by the rig
if cflib:
    from desk_rig import Crazyflie, SyncCrazyflie

LOGGED_S = 60.0 if os.environ.get("TEST_LONG") else 5.0


class Connected(AtTheDesk):
    def test_it_has_the_stock_firmware_s_and_the_app_s_names(self) -> None:
        with self.flown() as connected:
            self.assertGreater(sum(map(len, connected.cf.param.toc.toc.values())), 150)
            self.assertIn("rls", connected.cf.log.toc.toc)

    def test_what_the_library_s_examples_and_the_client_s_buttons_set_is_there(self) -> None:
        # Without effect here; of decks as well, since every image has their drivers.
        written = {"ring.effect": 7, "ring.solidRed": 100, "ring.fadeTime": 1.0, "ring.fadeColor": 0xA00000}
        written |= {"activeMarker.back": 30, "led.bitmask": 255, "health.startPropTest": 1, "system.taskDump": 1}
        written |= {"system.storageStats": 1, "velCtlPid.vxKFF": 0.5, "sound.effect": 1}
        with self.flown() as connected:
            param = connected.cf.param
            for name, value in written.items():
                param.set_value(name, value)
            time.sleep(0.5)
            self.assertEqual({name: float(param.get_value(name)) for name in written}, written)
            for name in ("ring.effect", "activeMarker.back", "sound.effect", "pm.lowVoltage"):
                self.assertTrue(param.toc.get_element_by_complete_name(name).is_persistent(), name)

    def test_a_client_that_has_never_seen_it_is_fully_connected_within_a_second(self) -> None:
        took_s = []
        for i in range(3):
            began_s = time.monotonic()
            with SyncCrazyflie(self.uri, cf=Crazyflie(rw_cache=str(self.folder / f"{i}"))) as connected:
                connected.wait_for_params()
                took_s.append(time.monotonic() - began_s)
        self.assertLess(min(took_s), 1.0)

    def test_a_parameter_is_set_or_put_back_and_the_client_told(self) -> None:
        with self.flown() as connected:
            param = connected.cf.param
            param.set_value("indiPos.kpz", 1.5)
            param.set_value("indiPos.kdz", -100)
            time.sleep(0.5)
            self.assertEqual(float(param.get_value("indiPos.kpz")), 1.5)
            self.assertGreater(float(param.get_value("indiPos.kdz")), 0)
            with self.assertRaises(AttributeError):
                param.set_value("deck.bcFlow2", 0)

    def test_a_block_of_100_Hz_loses_nothing(self) -> None:
        with self.flown() as connected:
            rows = self.logged(connected, LOGGED_S, "acc.z", "stateEstimate.z", "range.up", "rls.w1", period_ms=10)
        steps_ms = {after["ms"] - before["ms"] for before, after in zip(rows, rows[1:])}
        self.assertEqual(steps_ms, {10})


class Flying(AtTheDesk):
    def height_m(self, connected) -> float:
        return self.logged(connected, 0.0, "desk.z")[0]["desk.z"] - 0.017

    def test_motion_commander_flies_and_lands(self) -> None:
        with self.flown() as connected:
            with MotionCommander(connected, default_height=0.4) as commander:
                commander.forward(0.3, velocity=0.4)
                time.sleep(1.0)
                seen = self.logged(connected, 0.0, "desk.x", "desk.z")[0]
                self.assertAlmostEqual(seen["desk.x"], 0.3, delta=0.12)
                self.assertAlmostEqual(seen["desk.z"] - 0.017, 0.4, delta=0.08)
            time.sleep(1.0)
            self.assertLess(self.height_m(connected), 0.05)

    def test_high_level_commands_and_an_uploaded_trajectory_are_flown(self) -> None:
        with self.flown() as connected:
            commander = connected.cf.high_level_commander
            commander.takeoff(0.5, 1.5)
            time.sleep(3.0)
            self.assertAlmostEqual(self.height_m(connected), 0.5, delta=0.06)
            memory = connected.cf.mem.get_mems(MemoryElement.TYPE_TRAJ)[0]
            powers = (35 * 0.4 / 2**4, -84 * 0.4 / 2**5, 70 * 0.4 / 2**6, -20 * 0.4 / 2**7)  # 40 cm in 2 s
            straight = Poly4D.Poly([0.0, 0.0, 0.0, 0.0, *powers])
            memory.trajectory = [Poly4D(2.0, x=straight)]
            self.assertTrue(memory.write_data_sync())
            commander.define_trajectory(1, 0, 1)
            commander.start_trajectory(1, 1.0, relative_position=True)
            time.sleep(3.0)
            self.assertAlmostEqual(self.logged(connected, 0.0, "desk.x")[0]["desk.x"], 0.4, delta=0.15)
            commander.land(0.0, 1.5)
            time.sleep(2.0)

    def test_position_hl_commander_goes_places(self) -> None:
        with self.flown() as connected:
            with PositionHlCommander(connected, default_height=0.4, default_velocity=0.5) as commander:
                commander.go_to(0.3, -0.2)
                time.sleep(0.5)
                seen = self.logged(connected, 0.0, "stateEstimate.x", "stateEstimate.y")[0]
                self.assertAlmostEqual(seen["stateEstimate.x"], 0.3, delta=0.12)
                self.assertAlmostEqual(seen["stateEstimate.y"], -0.2, delta=0.12)

    def test_a_multiranger_sees_the_ceiling_and_a_covered_sensor(self) -> None:
        with self.flown() as connected, Multiranger(connected) as ranger:
            time.sleep(0.5)
            self.assertAlmostEqual(ranger.up, 1.47, delta=0.05)
            connected.cf.param.set_value("desk.cover", 1)
            time.sleep(0.5)
            self.assertAlmostEqual(ranger.up, 0.04, delta=0.01)

    def test_a_hand_beside_it_pushes_it_away(self) -> None:
        # As the library's example multiranger_push does, for a side each.
        with self.flown() as connected, Multiranger(connected) as ranger, MotionCommander(connected) as commander:
            for hand, side, axis, sign in ((1, "front", "x", -1), (3, "left", "y", -1)):
                self.assertIsNone(getattr(ranger, side))
                before = self.logged(connected, 0.0, f"desk.{axis}")[0][f"desk.{axis}"]
                connected.cf.param.set_value("desk.hand", hand)
                until_s = time.monotonic() + 1.5
                while time.monotonic() < until_s:
                    close = (getattr(ranger, side) or 1.0) < 0.2
                    away = sign * 0.4 * close
                    commander.start_linear_motion(away * (axis == "x"), away * (axis == "y"), 0)
                    time.sleep(0.1)
                connected.cf.param.set_value("desk.hand", 0)
                commander.stop()
                time.sleep(0.5)
                after = self.logged(connected, 0.0, f"desk.{axis}")[0][f"desk.{axis}"]
                self.assertGreater(sign * (after - before), 0.25)


class Lossy(AtTheDesk):
    def test_with_packets_lost_it_flies_on_and_time_does_not_run_ahead(self) -> None:
        with self.flown() as connected:
            connected.cf.param.set_value("desk.loss", 0.05)
            with MotionCommander(connected, default_height=0.4):
                began_s = time.monotonic()
                rows = self.logged(connected, 8.0, "desk.z", period_ms=20)
                # A machine with too much to do falls behind; nothing makes it hurry.
                self.assertLess((rows[-1]["ms"] - rows[0]["ms"]) / 1000, time.monotonic() - began_s + 0.5)
            self.assertGreater(len(rows), 350)
            self.assertTrue(all(row["desk.z"] > 0.3 for row in rows[100:]))


if __name__ == "__main__":
    unittest.main()
