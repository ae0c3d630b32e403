"""--dry-run prints what would be sent: without cflib, without a radio."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WITHOUT_CFLIB = "raise ImportError('cflib is not to be had')"


class DryRun(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "cflib.py").write_text(WITHOUT_CFLIB)

    def cf(self, *words: object) -> subprocess.CompletedProcess:
        command = [sys.executable, ROOT / "tools" / "cf.py", *words]
        return subprocess.run(
            list(map(str, command)), env={"PYTHONPATH": str(self.folder)}, capture_output=True, text=True, timeout=60
        )

    def test_learn_says_the_whole_flight(self) -> None:
        ran = self.cf("learn", "--dry-run", "--ceiling", 2)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        heights_m = [float(z) for z in re.findall(r"go to .* z (\S+) m", ran.stdout)]
        self.assertEqual(heights_m, [1.8, 1.9, 1.92, 1.94, 1.96, 1.98])
        order = ["set ceil.commit = 1", "take off", "go to", "land at", "set ceil.commit = 2", "store ceil.w7"]
        places = [ran.stdout.index(each) for each in order]
        self.assertEqual(places, sorted(places))

    def test_test_flight_says_the_whole_flight(self) -> None:
        ran = self.cf("test-flight", "--dry-run")
        self.assertEqual(re.findall(r"go to .* z (\S+) m", ran.stdout), ["1.300", "1.410", "1.450", "1.470"])
        self.assertNotIn("store", ran.stdout)

    def test_identify_says_its_hops_and_fits_nothing(self) -> None:
        ran = self.cf("identify", "--dry-run")
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        heights_m = re.findall(r"go to .* z (\S+) m", ran.stdout)
        self.assertEqual(heights_m, ["1.300"] + 12 * ["1.275", "1.300"])
        self.assertNotIn("motor lag", ran.stdout)

    def test_params_and_log_say_what_they_would_do(self) -> None:
        for words, says in (
            (("params", "list"), "would read all parameters\n"),
            (("params", "get", "ceil.min"), "would read ceil.min\n"),
            (("params", "set", "ceil.min=0.03"), "set ceil.min = 0.03\n"),
            (("params", "store", "ceil.min"), "store ceil.min\n"),
            (("log", "acc.z", "--out", self.folder / "x.csv"), "log acc.z every 20 ms\n"),
        ):
            with self.subTest(words=words):
                ran = self.cf(*words, "--dry-run")
                self.assertEqual((ran.returncode, ran.stderr), (0, ""))
                self.assertIn(says, ran.stdout)

    def test_it_says_its_version(self) -> None:
        ran = self.cf("--version")
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertRegex(ran.stdout, r"^cf\.py \d\S* \(commit .+\)\n$")

    def test_it_says_what_may_be_meant(self) -> None:
        for words, says in (
            (("lern",), "(did you mean learn?)"),
            (("params", "gett", "ceil.min"), "(did you mean get?)"),
            (("learn", "--dryrun"), "(did you mean --dry-run?)"),
            (("learn", "--hold", "99"), "argument --hold: 99: allowed are 1 to 60 s; "),
            (("identify", "--hold", "9"), "unrecognized arguments: --hold 9"),
        ):
            with self.subTest(words=words):
                ran = self.cf(*words)
                self.assertEqual((ran.returncode, ran.stderr.count("\n")), (2, 1))
                self.assertIn(says, ran.stderr)

    def test_it_writes_no_file(self) -> None:
        for words in (("log", "acc.z", "--out"), ("learn", "--log"), ("test-flight", "--log"), ("identify", "--log")):
            self.cf(*words, self.folder / "x.csv", "--dry-run")
            self.assertFalse((self.folder / "x.csv").exists())

    def test_bad_input_is_refused_here_too(self) -> None:
        for words, says in (
            (("test-flight", "--gaps", "1"), "nearer than 2 cm"),
            (("learn", "--ceiling", "9"), "allowed are 0.6 to 3 m"),
            (("params", "set", "ceil.min"), "allowed is NAME=VALUE"),
        ):
            with self.subTest(words=words):
                ran = self.cf(*words, "--dry-run")
                self.assertEqual(ran.returncode, 2)
                self.assertIn(says, ran.stderr)
                self.assertEqual(ran.stderr.count("\n"), 1)

    def test_without_a_dry_run_it_says_how_to_get_cflib(self) -> None:
        ran = self.cf("params", "list")
        self.assertEqual((ran.returncode, ran.stderr.count("\n")), (1, 1))
        self.assertIn("cflib is missing: make setup-cf", ran.stderr)

    def test_help_names_every_command(self) -> None:
        ran = self.cf("--help")
        self.assertEqual(ran.returncode, 0)
        for command in ("params", "log", "learn", "test-flight", "identify"):
            self.assertIn(command, ran.stdout)


if __name__ == "__main__":
    unittest.main()
