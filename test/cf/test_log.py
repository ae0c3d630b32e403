"""Logs over the link: what is in the file, and what becomes of it when something goes wrong."""

import math
import os
import signal
import unittest
from pathlib import Path

from fake_link import FakeLink
from rig import ROOT, OverTheLink

from cf.blocks import Block
from cf.record import Record

BIG = [f"indiIn.{name}" for name in "p q r ax ay az x y z vx vy vz".split()]


class Log(OverTheLink):
    def rows(self, name: str = "log.csv") -> list[dict[str, float]]:
        head, *rows = (self.folder / name).read_text().splitlines()
        return [dict(zip(head.split(","), map(float, row.split(",")), strict=True)) for row in rows]

    def test_a_log_has_crazyflie_names_and_a_row_each_period(self) -> None:
        self.vehicle.wrong = {"acc.z": 0.984375}
        ran = self.cf("log", "acc.z", "range.up", "--period", 100, "--for", 3, "--out", self.folder / "log.csv")
        self.assertEqual(ran.status, 0, ran.err)
        rows = self.rows()
        self.assertEqual(list(rows[0]), ["timestamp", "acc.z", "range.up"])
        self.assertIn(len(rows), (29, 30, 31))
        self.assertEqual({after["timestamp"] - before["timestamp"] for before, after in zip(rows, rows[1:])}, {100})
        self.assertEqual({(row["acc.z"], row["range.up"]) for row in rows}, {(0.984375, 1500)})
        self.assertIn(f"{len(rows)} rows in", ran.out)

    def test_more_than_26_bytes_go_into_several_blocks_and_one_row(self) -> None:
        self.vehicle.wrong = {name: float(i) for i, name in enumerate(BIG)}
        self.assertEqual(self.cf("log", *BIG, "--period", 50, "--for", 1, "--out", self.folder / "log.csv").status, 0)
        whole = {name: float(i) for i, name in enumerate(BIG)}
        rows = self.rows()
        self.assertEqual([{name: row[name] for name in BIG} for row in rows[:-1]], [whole] * (len(rows) - 1))

    def test_the_cfclient_configurations_can_be_logged(self) -> None:
        for folder in ("flying", "learning"):
            words = ("--config", ROOT / "tools" / "cfclient" / folder, "--for", 1, "--out", self.folder / "log.csv")
            self.assertEqual(self.cf("log", *words).status, 0)

    def test_ctrl_c_ends_a_log_that_is_whole(self) -> None:
        self.when(lambda v: v.time_s > 2.0, lambda _: os.kill(os.getpid(), signal.SIGINT))
        ran = self.cf("log", "acc.z", "--out", self.folder / "log.csv")
        self.assertEqual(ran.status, 0)
        self.assertGreater(len(self.rows()), 30)

    def test_what_came_before_the_link_was_lost_is_named_as_cut_and_replaces_nothing(self) -> None:
        (self.folder / "log.csv").write_text("of yesterday")
        (self.folder / "log.cut.csv").write_text("of this morning")
        for told in (True, False):
            self.when(lambda v: v.time_s > 2.0, lambda _: FakeLink.open.lose(told))
            self.vehicle.time_s = 0.0
            self.refused(1, "what came so far", "log", "acc.z", "--out", self.folder / "log.csv")
        self.assertEqual((self.folder / "log.csv").read_text(), "of yesterday")
        self.assertEqual((self.folder / "log.cut.csv").read_text(), "of this morning")
        self.assertGreater(len(self.rows("log.cut-2.csv")), 30)
        self.assertGreater(len(self.rows("log.cut-3.csv")), 30)
        self.assertEqual(len(list(self.folder.iterdir())), 4)

    def test_bad_input_is_refused_and_leaves_no_file(self) -> None:
        config = self.folder / "config.json"
        for text, words, says in (
            ("", ("acc.y", "acc.zz"), "acc.zz: no such log variable; did you mean acc."),
            ("", (), "nothing to log"),
            ("", ("acc.z", "--period", 15), "--period: 15 ms; allowed are 10 to 2540 ms in steps of 10"),
            ("", ("acc.z", "--period", 0), "--period: 0 ms"),
            ("", ("acc.z", "--for", 0), "allowed are 0.1 to 86400 s"),
            ("", ("acc.z", "--config", "/no/such.json"), "/no/such.json: No such file or directory"),
            ("{", ("--config", config), "config.json:1: 2: "),
            ("[]", ("--config", config), "no cfclient log configuration"),
            (block("no.such"), ("--config", config), "no.such: no such log variable"),
            (block("acc.z", kind="double"), ("--config", config), "acc.z is fetched as double; allowed are uint8_t"),
            (block(*BIG), ("--config", config), "48 bytes; allowed are 26 in a block"),
            (block("acc.z", period=7), ("--config", config), "7 ms; allowed are"),
        ):
            with self.subTest(says=says):
                config.write_text(text)
                self.refused(2, says, "log", *words, "--out", self.folder / "log.csv")
                self.assertEqual([each.name for each in self.folder.iterdir()], ["config.json"])

    def test_a_file_that_cannot_be_written_is_refused(self) -> None:
        for place in ("/no/such/folder/log.csv", self.folder, "/proc/log.csv"):
            with self.subTest(place=place):
                says = "allowed is the name of a file in a folder that can be written"
                self.refused(2, says, "log", "acc.z", "--out", place)

    def test_more_than_the_vehicle_can_send_is_refused(self) -> None:
        names = [row.name for row in self.vehicle.log_rows]
        self.assertGreater(4 * len(names), 16 * 26)
        self.refused(2, "allowed are 128 variables in 16 blocks", "log", *names, "--out", self.folder / "log.csv")


def block(*names: str, kind: str = "float", period: int = 100) -> str:
    variables = ",".join(f'{{"name": "{name}", "type": "TOC", "fetch_as": "{kind}"}}' for name in names)
    return f'{{"logconfig": {{"logblock": {{"name": "x", "period": {period}, "variables": [{variables}]}}}}}}'


class Rows(unittest.TestCase):
    def record(self, packets: list[tuple[str, int, float]]) -> list[str]:
        file = Path(self.enterContext(__import__("tempfile").TemporaryDirectory())) / "x.csv"
        record = Record("--out", file, [Block("a", 100, {"a": "float"}), Block("b", 100, {"b": "float"})])
        for name, stamp_ms, value in packets:
            record.take(name, stamp_ms, {name: value})
        return Path(record.end(True)).read_text().splitlines()[1:]

    def test_packets_of_one_period_share_a_row(self) -> None:
        for what, packets, rows in (
            ("in step", [("a", 0, 1.0), ("b", 3, 2.0), ("a", 100, 3.0), ("b", 103, 4.0)], ["0,1,2", "100,3,4"]),
            ("one missing", [("a", 0, 1.0), ("a", 100, 3.0), ("b", 103, 4.0)], ["0,1,nan", "100,3,4"]),
            ("one much later", [("a", 0, 1.0), ("b", 160, 4.0)], ["0,1,nan", "160,nan,4"]),
            ("the stamp wraps", [("a", 2**24 - 50, 1.0), ("a", 50, 2.0)], ["16777166,1,nan", "16777266,2,nan"]),
            ("a little early", [("a", 0, 1.0), ("a", 99, 2.0)], ["0,1,nan", "99,2,nan"]),
            ("no number", [("a", 0, math.nan), ("b", 0, 1.0)], ["0,nan,1"]),
        ):
            with self.subTest(what=what):
                self.assertEqual(self.record(packets), rows)


if __name__ == "__main__":
    unittest.main()
