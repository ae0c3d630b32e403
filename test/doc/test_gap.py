"""test_gap.py - what is told in short of the workflow's answers."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools/doc"))
import gap  # noqa: E402


class InShort(unittest.TestCase):
    def test_every_answer_has_its_words(self) -> None:
        rows = [
            ("Missing in out/v.toml: ceiling.", "ceiling"),
            ("Missing in out/v.toml: ceiling; mass or thrust_scale (more).", "ceiling; mass or thrust_scale (more)"),
            ("Missing in out/v.toml: ceiling; and something that has no name.", "ceiling + unknown"),
            ("Something is missing in out/v.toml that cannot be named.", "no name, something unknown"),
            ("Nothing is missing in out/v.toml that these flights could show.", "nothing"),
            ("These flights cannot tell what is missing in out/v.toml.", "not told"),
        ]
        for said, short in rows:
            self.assertEqual(gap.answer(f"{said}\n\nceiling: Something: x.\n"), short)

    def test_a_name_without_the_mass_is_wrong_beside_one_that_has_it(self) -> None:
        rows = [
            ([("ceiling", []), ("mass", ["thrust_scale"])], "named"),
            ([("ceiling", []), ("accel_bias", ["mass"])], "in its family"),
            ([("ceiling", ["mass"])], "in its family"),
            ([("ceiling", [])], "no name"),
            ([], "no name"),
            ([("mass", []), ("battery_sag", ["accel_bias"])], "WRONG"),
        ]
        for names, mark in rows:
            verdict = {"effects": [{"name": name, "rivals": rivals, "family": [name, *rivals]} for name, rivals in names]}
            self.assertEqual(gap.mass_mark(verdict)[0], mark, names)

    def test_a_name_its_numbers_and_what_is_left_are_kept(self) -> None:
        said = """\
Missing in x.toml: ground.

ground: a rotor above the ground
  Ca 0.504 +- 0.097; 9.96 % of the gap
  seen in force_z; held out, nearer than 0.07 m: 0.304 -> 0.135 m/s2 rms
  would do as well: delay; to tell them apart: fly

unknown: -0.0279 m/s2 in force_y

held out: 1 of 3 flights
  force_z   m/s2        0.455     0.113    0.0795
note: x.csv: 50 cells are empty
"""
        kept = [" ".join(line.split()) for line in gap.in_short(said)]
        want = ["ground Ca 0.504 +- 0.097; 9.96 % of the gap", "held out, nearer than 0.07 m: 0.304 -> 0.135 m/s2 rms"]
        want += ["would do as well: delay", "unknown: -0.0279 m/s2 in force_y", "force_z m/s2, held out: 0.455 -> 0.113"]
        self.assertEqual(kept, want)
        self.assertEqual(list(gap.in_short("gap: x.csv: no motors\n")), ["gap: x.csv: no motors"])


if __name__ == "__main__":
    unittest.main()
