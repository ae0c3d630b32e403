"""The stock library, and the commands of tools/cf.py, over UDP to out/desk: nothing of either is patched."""

import contextlib
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DESK = ROOT / os.environ.get("O", "out") / "desk"
PORT = 19871  # not the one that a person's own desk has

try:
    import cflib.crtp
    from cflib.crazyflie import Crazyflie
    from cflib.crazyflie.log import LogConfig
    from cflib.crazyflie.mem import MemoryElement, Poly4D
    from cflib.crazyflie.syncCrazyflie import SyncCrazyflie
    from cflib.crazyflie.syncLogger import SyncLogger
    from cflib.crtp.udpdriver import UdpDriver
    from cflib.positioning.motion_commander import MotionCommander
    from cflib.positioning.position_hl_commander import PositionHlCommander
    from cflib.utils.multiranger import Multiranger
except ImportError:
    cflib = None


@contextlib.contextmanager
def desk(*options: object):
    """A desk that is on, and its URI."""
    command = [DESK, "--port", PORT, "--page", 0, *options]
    running = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, text=True)
    try:
        assert running.stdout.readline().startswith("A simulated Crazyflie"), "the desk does not start"
        yield f"udp://127.0.0.1:{PORT}"
    finally:
        running.terminate()
        running.communicate(timeout=10)


@unittest.skipUnless(cflib and DESK.exists(), "no cflib, or no out/desk")
class AtTheDesk(unittest.TestCase):
    OPTIONS: tuple = ()

    def setUp(self) -> None:
        cflib.crtp.CLASSES[:] = [UdpDriver]
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.uri = self.enterContext(desk(*self.OPTIONS))

    @contextlib.contextmanager
    def flown(self):
        with SyncCrazyflie(self.uri, cf=Crazyflie(rw_cache=str(self.folder))) as connected:
            connected.wait_for_params()
            yield connected

    def logged(self, connected, seconds: float, *names: str, period_ms: int = 100) -> list[dict]:
        block = LogConfig("block", period_ms)
        for name in names:
            block.add_variable(name)
        rows = []
        with SyncLogger(connected, block) as logger:
            for stamp_ms, values, _ in logger:
                rows.append(values | {"ms": stamp_ms})
                if rows[-1]["ms"] - rows[0]["ms"] >= 1000 * seconds:
                    return rows
        return rows


class Connected(AtTheDesk):
    def test_it_has_the_stock_firmware_s_and_the_app_s_names(self) -> None:
        with self.flown() as connected:
            self.assertGreater(sum(map(len, connected.cf.param.toc.toc.values())), 150)
            self.assertIn("rls", connected.cf.log.toc.toc)

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
            rows = self.logged(connected, 5.0, "acc.z", "stateEstimate.z", "range.up", "rls.w1", period_ms=10)
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


class Commands(AtTheDesk):
    def cf(self, *words: object, status: int = 0) -> str:
        command = [sys.executable, ROOT / "tools" / "cf.py", "--uri", self.uri, *words]
        ran = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=200, cwd=self.folder)
        self.assertEqual(ran.returncode, status, ran.stderr)
        return ran.stdout if status == 0 else ran.stderr

    def test_parameters_are_listed_read_and_written(self) -> None:
        self.assertIn("indiPos.kpz", self.cf("params", "list"))
        self.cf("params", "set", "indiPos.kpz=1.5")
        self.assertEqual(self.cf("params", "get", "indiPos.kpz").split()[-1], "1.5")

    def test_in_shadow_it_does_not_learn(self) -> None:
        self.assertIn("ceil.shadow is 1", self.cf("learn", status=1))

    def test_it_learns_a_ceiling_that_it_then_holds(self) -> None:
        self.cf("params", "set", "ceil.shadow=0")
        learned = self.cf("learn", "--hold", "3")
        weights = [float(w) for w in re.findall(r"ceil\.w\d = (\S+)", learned)]
        self.assertEqual(len(weights), 7)
        self.assertIn("the weights are stored", learned)


class Kept(AtTheDesk):
    def test_what_is_stored_is_there_after_a_restart(self) -> None:
        storage = self.folder / "storage"
        with contextlib.ExitStack() as stack:  # another desk beside the first, on a port of its own
            global PORT
            PORT += 1
            stack.callback(lambda: globals().update(PORT=PORT - 1))
            for expected in (None, 1.5):
                with desk("--storage", storage) as self.uri, self.flown() as connected:
                    param = connected.cf.param
                    if expected is None:
                        param.set_value("indiPos.kpz", 1.5)
                        time.sleep(0.2)
                        done = []
                        param.persistent_store("indiPos.kpz", lambda name, ok: done.append(ok))
                        time.sleep(0.5)
                        self.assertEqual(done, [True])
                    else:
                        self.assertEqual(float(param.get_value("indiPos.kpz")), expected)


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


class WrongInput(unittest.TestCase):
    def refused(self, says: str, *words: object) -> None:
        ran = subprocess.run(list(map(str, [DESK, *words])), capture_output=True, text=True, timeout=20)
        self.assertEqual((ran.returncode, ran.stderr.count("\n")), (2, 1), ran.stderr)
        self.assertIn(says, ran.stderr)

    @unittest.skipUnless(DESK.exists(), "no out/desk")
    def test_it_ends_with_one_line(self) -> None:
        with desk():
            self.refused("is it running already?", "--port", PORT, "--page", 0)
        for says, *words in (
            ("--port 0: allowed is a whole number from 1 to 65535", "--port", 0),
            ("--address here: allowed is an IPv4 address", "--address", "here", "--page", 0),
            ("--speed 0: allowed", "--speed", 0),
            ("--link los=1: allowed is loss=SHARE,delay=SECONDS", "--link", "los=1"),
            ("no-such.toml", "no-such.toml"),
            ("--drones 11: allowed", "--drones", 11),
        ):
            with self.subTest(words=words):
                self.refused(says, *words)


if __name__ == "__main__":
    unittest.main()
