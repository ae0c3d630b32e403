"""What the commands and the cfclient files name is what the app declares."""

import re
import unittest

import declared
from rig import HAS_APP, NAMES, ROOT, TREE

from cf import app, blocks, reasons
from cf.ladder import CONFIGS

BLOCKS = [block for folder in ("flying", "learning") for block in blocks.read(CONFIGS / folder)]


@unittest.skipUnless(HAS_APP, "no src/firmware: nothing is declared")
class Declared(unittest.TestCase):
    def setUp(self) -> None:
        self.params = {row.name: row for row in NAMES.params + declared.STOCK.params}
        self.logs = {row.name: row for row in NAMES.logs + declared.STOCK.logs}

    def test_the_source_declares_its_whole_table_of_parameters(self) -> None:
        table = (TREE / "include" / "flight" / "params.h").read_text()
        rows = re.findall(r"X\((\w+), (\w+), PARAM_", table)
        self.assertGreater(len(rows), 50)
        self.assertLessEqual({f"{group}.{name}" for group, name in rows}, set(self.params))

    def test_group_and_name_fit_into_26_characters(self) -> None:
        for name in [*self.params, *self.logs]:
            self.assertLessEqual(len(name) + 1, 26, name)

    def test_what_the_commands_use_is_declared(self) -> None:
        self.assertLessEqual(set(app.PARAMS), set(self.params))
        self.assertLessEqual(set(app.LOGS), set(self.logs))

    def test_what_is_stored_is_persistent(self) -> None:
        for name in (*app.STORED, "ceil.shadow"):
            self.assertTrue(self.params[name].persistent, name)

    def test_it_starts_in_shadow(self) -> None:
        self.assertEqual(self.params["ceil.shadow"].initial, 1)

    def test_the_reasons_are_all_rows_of_the_headers_by_their_bits(self) -> None:
        for header, names in (("guard.h", reasons.GUARD), ("flyable.h", reasons.FLYABLE)):
            text = (TREE / "include" / "flight" / header).read_text()
            self.assertEqual(text.count("\n  X("), len(names), header)
        self.assertEqual(reasons.words(1 << 16 | 1, reasons.GUARD), f"{reasons.GUARD[0]}, the estimated velocity jumps")
        self.assertEqual(reasons.words(1, reasons.FLYABLE), "at rest the accelerometer does not point up")


class CfclientFiles(unittest.TestCase):
    def test_each_variable_is_declared_with_its_type(self) -> None:
        if not HAS_APP:
            self.skipTest("no src/firmware: nothing is declared")
        kinds = {row.name: row.kind for row in NAMES.logs + declared.STOCK.logs}
        for block in BLOCKS:
            for name, kind in block.types.items():
                with self.subTest(block=block.name, name=name):
                    self.assertEqual(kinds.get(name), kind)

    def test_each_block_fits_into_a_packet(self) -> None:
        for block in BLOCKS:
            self.assertLessEqual(blocks.size_bytes(block), blocks.BLOCK_BYTES, block.name)
            self.assertGreater(blocks.size_bytes(block), 0, block.name)

    def test_they_fit_beside_the_monitor_s_blocks(self) -> None:
        blocks.check([*BLOCKS, *app.WATCHED, *app.WATCHED[:2]])  # two more while the weights are read

    def test_a_variable_is_in_one_block_only_and_blocks_have_names_of_their_own(self) -> None:
        names = [name for block in BLOCKS for name in block.types]
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual(len(BLOCKS), len({block.name for block in BLOCKS}))

    def test_they_are_in_the_readme(self) -> None:
        self.assertTrue("tools/cfclient" in (ROOT / "src/firmware/README.md").read_text())


if __name__ == "__main__":
    unittest.main()
