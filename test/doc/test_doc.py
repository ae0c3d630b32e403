"""test_doc.py - what the documentation driver refuses, what it writes, and what it leaves as it is."""

import contextlib
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools/doc"))
import doc  # noqa: E402
import run  # noqa: E402
from recipes import Recipe  # noqa: E402


def block(name: str, text: str = "old\n") -> str:
    return f"before\n<!-- {name} -->\n{text}<!-- end -->\nafter\n"


def says(text: str):
    return lambda: print(text)


def fails() -> None:
    print("half of it")
    raise run.Failed("it broke")


def leaves() -> None:
    raise run.Left("no compiler")


TWO = {"one": Recipe(says("first")), "two": Recipe(says("second"), markdown=True)}
DRAWN = {"sky": Recipe(says("<svg/>"), picture=".doc/sky.svg")}


class InATree(unittest.TestCase):
    def setUp(self) -> None:
        tree = tempfile.TemporaryDirectory()
        self.addCleanup(tree.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(tree.name)

    def tree(self, files: dict[str, str]) -> None:
        for name, text in files.items():
            Path(name).parent.mkdir(parents=True, exist_ok=True)
            Path(name).write_text(text)

    def doc(self, recipes: dict[str, Recipe], *words: str) -> tuple[int, str]:
        with contextlib.redirect_stdout(io.StringIO()) as said, contextlib.redirect_stderr(said):
            return doc.main(list(words), recipes), said.getvalue()


class Refusals(InATree):
    def test_what_does_not_fit_is_refused_and_nothing_is_written(self) -> None:
        one, two = block("one"), block("two")
        rows = [
            (TWO, {"README.md": one}, "recipes without a place: two"),
            (TWO, {"README.md": one + two, "sim/README.md": block("third")}, "sim/README.md: third has no recipe"),
            (TWO, {"README.md": one + two, "src/README.md": one}, "one stands twice, in README.md and in src/README.md"),
            (TWO, {"README.md": one + two + one}, "README.md: a block stands here twice: one end two end one end"),
            (TWO, {"README.md": "<!-- one -->\n" + two}, "README.md: not every block has its end: one two end"),
            (TWO, {"README.md": one + "<!-- end -->\n"}, "README.md: not every block has its end: one end end"),
            (TWO, {"README.md": one + "<!-- two -->\n"}, "README.md: not every block has its end: one end two"),
            (DRAWN, {"README.md": "no picture\n"}, "recipes without a place: sky"),
            (DRAWN, {"README.md": block("sky")}, "README.md: sky has no recipe"),
            (DRAWN, {"README.md": "", "sim/LOGS.md": "![Rain](../.doc/rain.svg)\n"},
             "sim/LOGS.md: the picture .doc/rain.svg has no recipe"),
        ]  # fmt: skip
        for recipes, files, why in rows:
            with self.subTest(why):
                self.setUp()
                self.tree(files)
                for words in (["check"], ["write"]):
                    self.assertEqual(self.doc(recipes, *words), (1, f"doc: {why}\n"))
                self.assertEqual({name: Path(name).read_text() for name in files}, files)

    def test_a_word_that_no_name_has_is_refused(self) -> None:
        self.tree({"README.md": block("one") + block("two")})
        status, said = self.doc(TWO, "write", "three")
        self.assertEqual((status, said), (1, "doc: no recipe's name has three; there are one, two\n"))
        self.assertEqual(self.doc(TWO, "show", "three")[0], 2)


class Writing(InATree):
    def test_blocks_are_written_wherever_they_stand(self) -> None:
        self.tree({"README.md": "front\n", "sim/gap/LOGS.md": block("one"), "src/README.md": "x\n" + block("two", "")})
        self.assertEqual(self.doc(TWO, "write")[0], 0)
        self.assertEqual(Path("sim/gap/LOGS.md").read_text(), block("one", "```\nfirst\n```\n"))
        self.assertEqual(Path("src/README.md").read_text(), "x\n" + block("two", "second\n"))
        self.assertIn("as it was", self.doc(TWO, "write", "two")[1])

    def test_a_word_chooses(self) -> None:
        self.tree({"README.md": block("one") + block("two")})
        self.assertEqual(self.doc(TWO, "write", "tw")[0], 0)
        self.assertEqual(Path("README.md").read_text(), block("one") + block("two", "second\n"))

    def test_a_picture_is_written_where_a_page_shows_it(self) -> None:
        self.tree({"README.md": "", "sim/README.md": "![Sky](../.doc/sky.svg)\n", ".doc/none": ""})
        self.assertEqual(self.doc(DRAWN, "write")[0], 0)
        self.assertEqual(Path(".doc/sky.svg").read_text(), "<svg/>\n")

    def test_what_fails_is_left_and_the_others_are_written(self) -> None:
        recipes = {"broken": Recipe(fails), "silent": Recipe(lambda: None), "absent": Recipe(leaves), **TWO}
        recipes["flown"] = Recipe(says("never"), data=True)
        self.tree({"README.md": "".join(block(name) for name in recipes)})
        status, said = self.doc(recipes, "write")
        self.assertEqual(status, 1)
        for why in ("FAILED, left as it is: it broke", "FAILED, left as it is: it says nothing", "is: no compiler",
                    "left as it is: it needs recorded flights"):  # fmt: skip
            self.assertIn(why, said)
        kept = "".join(block(name) for name in ("broken", "silent", "absent"))
        made = block("one", "```\nfirst\n```\n") + block("two", "second\n")
        self.assertEqual(Path("README.md").read_text(), kept + made + block("flown"))

    def test_what_was_typed_meanwhile_stays(self) -> None:
        def slow() -> None:
            Path("README.md").write_text("typed meanwhile\n" + block("one"))
            print("new")

        self.tree({"README.md": block("one")})
        self.assertEqual(self.doc({"one": Recipe(slow)}, "write")[0], 0)
        self.assertEqual(Path("README.md").read_text(), "typed meanwhile\n" + block("one", "```\nnew\n```\n"))

    def test_what_differs_between_machines_is_left_out(self) -> None:
        self.tree({"README.md": block("one")})
        self.doc({"one": Recipe(says("done, 12 x real time"), leaves_out=r", \d+ x real time")}, "write")
        self.assertEqual(Path("README.md").read_text(), block("one", "```\ndone\n```\n"))


class Typed(InATree):
    def test_what_is_shown_is_what_ran(self) -> None:
        recipes = {"one": Recipe(lambda: run.typed("for i in 1 2; do\n  echo $i >>ran; echo said $i\ndone"))}
        self.tree({"README.md": block("one")})
        self.assertEqual(self.doc(recipes, "write")[0], 0)
        shown = "$ for i in 1 2; do\n  echo $i >>ran; echo said $i\ndone\nsaid 1\nsaid 2\n"
        self.assertEqual(Path("README.md").read_text(), block("one", f"```\n{shown}```\n"))
        self.assertEqual(Path("ran").read_text(), "1\n2\n")

    def test_a_line_that_fails_is_not_shown_as_done(self) -> None:
        self.tree({"README.md": block("one")})
        status, said = self.doc({"one": Recipe(lambda: run.typed("echo said; false; echo more"))}, "write")
        self.assertEqual((status, Path("README.md").read_text()), (1, block("one")))
        self.assertIn("FAILED, left as it is: sh ends with 1", said)


if __name__ == "__main__":
    unittest.main()
