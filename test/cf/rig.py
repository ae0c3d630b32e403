"""rig.py - runs a command of tools/cf.py in this process, over a fake link, and keeps what it said and sent."""

import contextlib
import io
import os
import sys
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TREE = Path(os.environ.get("FIRMWARE_TREE", ROOT))  # whose src/firmware declares the names
sys.path[:0] = [str(ROOT / "tools"), str(Path(__file__).resolve().parent)]

import cflib.crtp
import declared
from fake_link import FakeLink, now_s, pass_time
from fake_vehicle import FakeVehicle

from cf.vehicle import Vehicle

WEIGHTS = [f"ceil.w{i}" for i in range(1, 8)]
FLAT = {f"ground.w{i}": float(i == 1) for i in range(1, 8)}  # of the same set, as shipped
HAS_APP = (TREE / "src" / "firmware").is_dir()
NAMES = declared.read(TREE) if HAS_APP else declared.Declared((), ())


def main(words: list[str]) -> int:
    """The program, whose name is also that of the package of its parts."""
    import importlib.util

    spec = importlib.util.spec_from_file_location("cf_program", ROOT / "tools" / "cf.py")
    program = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(program)
    return program.main(words)


@dataclass
class Ran:
    status: int
    out: str
    err: str


@unittest.skipUnless(HAS_APP, "no src/firmware: nothing is declared")
class OverTheLink(unittest.TestCase):
    """Each test has a vehicle on the floor, 1.5 m below a ceiling, and a folder of its own."""

    def setUp(self) -> None:
        self.vehicle = FakeVehicle(NAMES)
        FakeLink.vehicle = self.vehicle
        cflib.crtp.CLASSES[:] = [FakeLink]
        Vehicle.now, Vehicle.sleep = staticmethod(now_s), staticmethod(pass_time)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def cf(self, *words: object, uri: str = "fake://cf") -> Ran:
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = main(["--uri", uri, *map(str, words)])
        return Ran(status, out.getvalue(), err.getvalue())

    def refused(self, status: int, says: str, *words: object) -> Ran:
        """The command ends so, with one line that says this."""
        ran = self.cf(*words)
        self.assertEqual(ran.status, status, ran.err)
        self.assertEqual(ran.err.count("\n"), 1, f"not one line: {ran.err}")
        self.assertIn(says, ran.err)
        return ran

    def when(self, condition, act) -> None:
        """act(vehicle) once, at the first step at which condition(vehicle) holds."""
        waits = [True]

        def step(vehicle: FakeVehicle) -> None:
            if waits and condition(vehicle):
                waits.clear()
                act(vehicle)

        self.vehicle.on_step = step

    def flown(self) -> list[str]:
        return [each[0] for each in self.vehicle.sent]

    def gaps_mm(self) -> list[int]:
        """What was commanded in the air, below the ceiling."""
        return [round(1000 * (self.vehicle.ceiling_m - z)) for kind, z, *_ in self.went()]

    def went(self) -> list[tuple]:
        return [each for each in self.vehicle.sent if each[0] == "go to"]
