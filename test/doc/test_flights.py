"""test_flights.py - the table of the thesis's flights: what it makes of fly's JSON, and what it refuses."""

import contextlib
import io
import os
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools/doc"))
import flights  # noqa: E402
import run  # noqa: E402

FAR = {"setpoint_m": 0.4, "mean_error_mm": 1, "sd_mm": 2, "contacts": 0, "tilt_max_deg": 3, "min_gap_mm": 90}
FLIGHT = {"segments": [FAR, FAR], "ceiling_m": 0.5, "rotor_radius_m": 0.02}


def table(flown: dict[str, list[dict]]) -> str:
    with contextlib.redirect_stdout(io.StringIO()) as said:
        flights.table(flown, sd_of_free=True)
    return said.getvalue()


class Table(unittest.TestCase):
    def test_a_row_holds_all_flights(self) -> None:
        said = table({"indi": [FLIGHT]})
        self.assertIn("indi            100  5.00    99.0  4.95     2.0  0.10     1.0     2.0      0     0/1    90.0", said)
        self.assertIn("indi             2.00 mm   1.00  of 1", said)
        touching = {**FLIGHT, "segments": [FAR, {**FAR, "contacts": 3, "mean_error_mm": 3, "min_gap_mm": 1}]}
        said = table({"indi": [FLIGHT, touching]})
        self.assertIn("indi            100  5.00    98.0  4.90     2.2  0.11     2.0     2.0      3     1/2     1.0", said)
        self.assertIn("none", table({"indi": [touching]}))

    def test_it_says_what_flew(self) -> None:
        other = {**FLIGHT, "set": {"ceil.blindMax": 60, "ceil.min": 0}}
        said = table({"indi": [other], "stock-pid": [FLIGHT]})
        self.assertIn("as shipped, but for --set ceil.blindMax=60 --set ceil.min=0\n", said)
        with self.assertRaisesRegex(run.Failed, "not all with the same parameters"):
            table({"indi": [other], "indi-rbf": [{**FLIGHT, "set": {}}]})

    def test_a_flight_without_a_number_is_refused(self) -> None:
        without = {key: value for key, value in FLIGHT.items() if key != "ceiling_m"}
        null = {**FLIGHT, "segments": [FAR, {**FAR, "mean_error_mm": None}]}
        for flight, key in ((without, "ceiling_m"), (null, "mean_error_mm")):
            with self.assertRaisesRegex(run.Failed, f"no number {key}$"):
                table({"indi": [flight]})


class Flown(unittest.TestCase):
    def test_it_ends_where_a_flight_fails(self) -> None:
        rows = [
            ("exit 1", "fly ends with 1$"),
            ('while [ "$1" != --json ]; do shift; done; echo {} >"$2"', "not the 10 flights that were asked for$"),
        ]
        for script, why in rows:
            out = self.enterContext(tempfile.TemporaryDirectory())
            with self.subTest(script), unittest.mock.patch.object(run, "OUT", Path(out)):
                fly = Path(out, "fly")
                fly.write_text(f"#!/bin/sh\n{script}\n")
                os.chmod(fly, 0o755)
                with self.assertRaisesRegex(run.Failed, why), contextlib.redirect_stdout(io.StringIO()):
                    flights.flights()


if __name__ == "__main__":
    unittest.main()
