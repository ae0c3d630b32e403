"""The commands of tools/cf.py at the desk, what it keeps and flies anew, and what it refuses."""

import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from desk_rig import DESK, PORT, ROOT, AtTheDesk, cflib, desk

if cflib:
    from desk_rig import Crazyflie, SyncCrazyflie, UdpDriver


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
        for expected in (None, 1.5):
            # Another desk beside the first.
            with desk("--storage", storage, port=PORT + 1) as self.uri, self.flown() as connected:
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


class FlownAnew(unittest.TestCase):
    """What clients sent is flown again by fly, as the recording itself says."""

    @unittest.skipUnless(cflib and DESK.exists(), "no cflib, or no out/desk")
    def test_the_same_commands_are_the_same_flight_to_the_bit_at_any_speed(self) -> None:
        cflib.crtp.CLASSES[:] = [UdpDriver]
        for speed in (1, 20):
            with self.subTest(speed=speed), tempfile.TemporaryDirectory() as made:
                folder = Path(made)
                (folder / "storage").write_text("indiPos.kpz = 1.4\n")
                (folder / "scene.toml").write_text('ceiling_m = 0.9\n[[effect]]\nis = "mass:add=0.002,start=3"\n')
                options = ("--speed", speed, "--seed", 7, "--noise", "flown", "--storage", folder / "storage")
                with desk(folder / "scene.toml", "--log", folder, *options) as uri:
                    with SyncCrazyflie(uri, cf=Crazyflie(rw_cache=made)) as connected:
                        connected.wait_for_params()
                        connected.cf.param.set_value("ceil.shadow", 0)
                        connected.cf.param.persistent_store("indiPos.kpz")
                        connected.cf.high_level_commander.takeoff(0.5, 2.0)
                        time.sleep(4.0)
                        connected.cf.param.set_value("desk.cover", 1)
                        connected.cf.high_level_commander.land(0.0, 2.0)
                        time.sleep(1.0)
                recorded = (folder / "0.commands").read_text()
                again = re.search("# flown anew by: (.*)", recorded)[1].replace("FILE.csv", f"{made}/again.csv")
                self.assertTrue(again.startswith("out/fly "))
                subprocess.run(again.replace("out/fly", str(DESK.with_name("fly")), 1), shell=True, check=True)
                rows = [(folder / name).read_text().splitlines() for name in ("0.csv", "again.csv")]
                both = min(map(len, rows))
                self.assertGreater(both, 400 * speed)
                self.assertEqual(rows[0][:both], rows[1][:both])
                z = rows[0][0].split(",").index("stateEstimate.z")
                self.assertGreater(max(float(row.split(",")[z]) for row in rows[0][1:]), 0.4)


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
