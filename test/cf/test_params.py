"""Parameters over the link: list, get, set, store."""

import unittest

from rig import NAMES, OverTheLink


class Params(OverTheLink):
    def test_list_shows_every_parameter_with_its_type(self) -> None:
        ran = self.cf("params", "list")
        self.assertEqual(ran.status, 0, ran.err)
        lines = dict(line.split(maxsplit=1) for line in ran.out.splitlines())
        self.assertEqual(len(lines), len(self.vehicle.param_rows))
        self.assertEqual(lines["ceil.min"].split(), ["0.02", "float", "persistent"])
        self.assertEqual(lines["deck.bcFlow2"].split(), ["1", "uint8_t", "read-only"])

    def test_list_takes_patterns(self) -> None:
        ran = self.cf("params", "list", "ceil.w?", "rls.q")
        self.assertEqual([line.split()[0] for line in ran.out.splitlines()], [f"ceil.w{i}" for i in range(1, 8)] + ["rls.q"])

    def test_every_parameter_of_the_table_can_be_read(self) -> None:
        self.vehicle.param["ceil.shadow"] = 1  # as it comes
        ran = self.cf("params", "get", *(row.name for row in NAMES.params))
        for row, line in zip(NAMES.params, ran.out.splitlines(), strict=True):
            name, value = line.split(" = ")
            self.assertEqual(name, row.name)
            self.assertAlmostEqual(float(value), row.initial, delta=1e-6 * max(1, abs(row.initial)))

    def test_set_writes_and_reads_back(self) -> None:
        ran = self.cf("params", "set", "ceil.min=0.03", "ceil.mode=2")
        self.assertEqual((ran.status, ran.out), (0, "ceil.min = 0.03\nceil.mode = 2\n"))
        self.assertEqual([name for name, _ in self.vehicle.writes], ["ceil.min", "ceil.mode"])

    def test_store_stores(self) -> None:
        ran = self.cf("params", "store", "ceil.min", "ceil.w3")
        self.assertEqual(ran.status, 0, ran.err)
        self.assertEqual(list(self.vehicle.stored), ["ceil.min", "ceil.w3"])

    def test_a_commit_is_taken_or_said_to_be_refused(self) -> None:
        ran = self.cf("params", "set", "ceil.w1=1.5", "ceil.commit=1")
        self.assertEqual(ran.out, "ceil.w1 = 1.5\nceil.commit 1 taken\n")
        self.assertEqual(self.vehicle.theta[0], 1.5)
        for words in (("ceil.commit=3",), ("ceil.w1=9", "ceil.commit=1")):
            ran = self.cf("params", "set", *words)
            self.assertEqual((ran.status, ran.err.count("\n")), (1, 1))
            self.assertIn("was refused; allowed are 1 and 2, weights of -5 to 5", ran.err)

    def test_bad_input_is_refused_and_nothing_is_written(self) -> None:
        for words, says in (
            (("set", "ceil.mode=2", "ceil.mni=0.03"), "did you mean ceil.min?"),
            (("get", "nothing.atAll"), "no such parameter; allowed are group.name"),
            (("set", "ceil.mode=2", "ceil.min=near"), "ceil.min=near: no number"),
            (("set", "ceil.mode=2", "ceil.min=nan"), "no number"),
            (("set", "ceil.mode=2", "ceil.shadow=256"), "allowed are whole numbers, 0 to 255"),
            (("set", "ceil.mode=1.5"), "allowed are whole numbers"),
            (("set", "ceil.min"), "allowed is NAME=VALUE"),
            (("set", "deck.bcFlow2=0"), "read-only"),
            (("store", "ceil.min", "ceil.commit"), "ceil.commit: cannot be stored"),
            (("list", "seil.*"), "no parameter is called so"),
            (("forget", "ceil.min"), "invalid choice"),
        ):
            with self.subTest(words=words):
                self.refused(2, says, "params", *words)
                self.assertEqual((self.vehicle.writes, self.vehicle.stored), ([], {}))

    def test_a_value_that_the_app_takes_back_is_told(self) -> None:
        self.refused(1, "ceil.min: 7 was not taken, it is 0.02", "params", "set", "ceil.min=7.0")

    def test_a_store_that_fails_is_told(self) -> None:
        self.vehicle.store_fails.add("ceil.min")
        self.refused(1, "ceil.min: the Crazyflie could not store it", "params", "store", "ceil.min")

    def test_an_uri_that_nobody_knows_is_refused(self) -> None:
        ran = self.cf("params", "list", uri="telegraph://7")
        self.assertEqual(ran.status, 2)
        self.assertIn("telegraph://7: no such link; allowed are radio://", ran.err)


if __name__ == "__main__":
    unittest.main()
