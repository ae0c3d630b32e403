"""The commands of tools/cf.py at the desk, and what it keeps and flies anew."""

import re
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

from desk_rig import DESK, AtTheDesk, cflib, desk

if cflib:
    from desk_rig import Crazyflie, SyncCrazyflie, UdpDriver


class Commands(AtTheDesk):
    def test_parameters_are_listed_read_and_written(self) -> None:
        self.assertIn("indiPos.kpz", self.cf("params", "list"))
        self.cf("params", "set", "indiPos.kpz=1.5")
        self.assertEqual(self.cf("params", "get", "indiPos.kpz").split()[-1], "1.5")

    def test_logs_go_into_a_file_at_the_period_that_is_asked_for(self) -> None:
        self.cf("log", "desk.gap", "rls.w1", "range.up", "--out", "flown.csv", "--period", 10, "--for", 2)
        names, *rows = ((self.folder / "flown.csv").read_text()).splitlines()
        self.assertEqual(names.split(","), ["timestamp", "desk.gap", "rls.w1", "range.up"])
        stamps_ms = [int(row.split(",")[0]) for row in rows]
        self.assertGreater(len(rows), 150)
        self.assertEqual({b - a for a, b in zip(stamps_ms, stamps_ms[1:])}, {10})

    def test_weights_are_written_down_and_loaded_again(self) -> None:
        names = [f"ceil.w{i}" for i in range(1, 8)]
        typed = [f"{name}={0.1 * i:g}" for i, name in enumerate(names, 1)]
        self.cf("params", "set", *typed, "ceil.commit=1")
        saved = [line.split() for line in self.cf("params", "get", *names).splitlines()]
        self.cf("params", "store", *names, "ceil.wSum", "ceil.mode")
        self.cf("params", "set", "desk.restart=1")
        time.sleep(1.5)
        self.assertEqual([line.split() for line in self.cf("params", "get", *names).splitlines()], saved)
        self.assertEqual([round(float(line[-1]), 4) for line in saved], [round(0.1 * i, 4) for i in range(1, 8)])


class Kept(AtTheDesk):
    def test_what_is_stored_is_there_after_a_restart(self) -> None:
        storage = self.folder / "storage"
        for expected in (None, 1.5):
            # Another desk beside the first.
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
                again = again.replace("out/fly", str(DESK.with_name("fly")), 1)
                subprocess.run(again, shell=True, check=True, stdout=subprocess.DEVNULL)
                rows = [(folder / name).read_text().splitlines() for name in ("0.csv", "again.csv")]
                both = min(map(len, rows))
                self.assertGreater(both, 400 * speed)
                self.assertEqual(rows[0][:both], rows[1][:both])
                z = rows[0][0].split(",").index("stateEstimate.z")
                self.assertGreater(max(float(row.split(",")[z]) for row in rows[0][1:]), 0.4)


if __name__ == "__main__":
    unittest.main()
