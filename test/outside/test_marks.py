"""test_marks.py - how the answers to flights of another simulator are marked."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tools/outside"))
import marks  # noqa: E402
import reliability  # noqa: E402


def verdict(*effects: tuple, unknown: bool = False) -> dict:
    """Each effect: its name, then its rivals."""
    return {"verdict": "named" if effects else "none", "warnings": [],
            "effects": [{"name": name, "rivals": list(rivals)} for name, *rivals in effects],
            "unknown": {"channel": "force_z", "coordinate": "time"} if unknown else None}


class Marks(unittest.TestCase):
    def test_answers(self):
        rows = (  # what was hidden, the answer; right, false, beside, exact
            ([], verdict(), 0, 0, 0, True),
            ([], verdict(("mass",)), 0, 1, 0, False),
            ([], verdict(unknown=True), 0, 0, 0, True),  # counted in a column of its own
            (["mass"], verdict(), 0, 0, 0, False),
            (["mass"], verdict(("mass",)), 1, 0, 0, True),
            (["mass"], verdict(("thrust_scale",)), 0, 1, 0, False),  # the rival is not told
            (["mass"], verdict(("thrust_scale", "mass")), 1, 0, 0, True),
            (["mass"], verdict(("rotor_drag", "mass")), 0, 1, 0, False),  # told, but of no family with it
            (["mass"], verdict(("mass",), ("thrust_scale", "mass")), 1, 1, 0, False),  # the same twice
            (["mass", "delay"], verdict(("motor_lag", "delay"), ("mass",)), 2, 0, 0, True),
            (["mass", "delay"], verdict(("mass",)), 1, 0, 0, False),
            (["battery_sag"], verdict(("battery_sag",), ("mass",)), 1, 0, 1, False),
            (["ceiling"], verdict(("ceiling",), ("mass",)), 1, 1, 0, False),
        )
        for hidden, answer, right, false, beside, exact in rows:
            with self.subTest(hidden=hidden, answer=answer["effects"]):
                m = marks.mark(answer, hidden)
                self.assertEqual((m.right, m.false, m.beside, m.exact), (right, false, beside, exact))

    def test_a_family_in_the_verdict_counts_as_rivals_do(self):
        answer = verdict(("thrust_scale",))
        answer["effects"][0]["family"] = ["mass", "thrust_scale"]
        self.assertTrue(marks.mark(answer, ["mass"]).exact)
        answer["effects"][0]["family"] = "lift"  # names nothing
        self.assertFalse(marks.mark(answer, ["mass"]).exact)

    def test_a_refusal_is_never_exact(self):
        refused = {"verdict": "refused", "effects": [], "unknown": None, "warnings": ["vehicle.toml:3: x"]}
        m = marks.mark(refused, [])
        self.assertFalse(m.exact)
        self.assertEqual(m.line, "vehicle.toml:3: x")

    def test_what_is_stated(self):
        answer = verdict(("mass",), ("wind",), ("delay",))
        for effect, p in zip(answer["effects"], (0.99, 0.97, 0.5)):
            effect["probability"] = p
        m = marks.mark(answer, ["mass"])
        self.assertEqual(m.stated, [(0.99, True), (0.97, False), (0.5, False)])

    def test_the_reliability_diagram(self):
        stated = [(1.0, True), (0.95, True), (0.99, False), (0.97, True), (0.9499, True), (0.8, False), (0.0, False),
                  (None, True), (None, False)]
        self.assertEqual(reliability.table(stated).splitlines(), [  # as the exam's (test/exam/test_reliability.c)
            "  stated           mean       right            90 % interval",
            "  0    to 0.5      0.000    0/1      0.0 %     0.0 to  73.0 %",
            "  0.5  to 0.8          -    0/0",
            "  0.8  to 0.95     0.875    1/2     50.0 %    12.1 to  87.9 %",
            "  0.95 to 1        0.978    3/4     75.0 %    35.6 to  94.2 %",
            "  names without a probability: 2"])

    def test_the_table_counts(self):
        all_marks = [marks.mark(verdict(("mass",)), ["mass"]), marks.mark(verdict(("wind",)), []),
                     marks.mark(verdict(unknown=True), ["wind", "delay"]),
                     marks.mark({"verdict": "refused", "effects": [], "warnings": ["x"]}, [])]
        lines = marks.table(all_marks).splitlines()
        self.assertEqual(lines[1].split(), ["nothing", "2", "0", "0", "0", "1", "0", "1"])
        whole = next(line for line in lines if line.startswith("all"))
        self.assertEqual(whole.split()[1:], ["4", "3", "1", "1", "1", "1", "1"])
        self.assertIn("named: 1/3 33 % of what was hidden", lines)
        self.assertIn("exact: 1/2 50 % of the sets that hide something", lines)
        self.assertIn("nothing hidden, and read: a name in 1/1 100 %, unknown in 0/1 0 %", lines)
        self.assertEqual(lines[-1], "  names without a probability: 2")


if __name__ == "__main__":
    unittest.main()
