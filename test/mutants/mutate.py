"""mutate.py - what small mistakes a file of C could hold: every mutant of it, place by place.

Knows tokens, not C: what it makes need not compile, and the one who builds it finds out.
"""

import re
from dataclasses import dataclass

TOKEN = re.compile(
    r"""(?P<skip>\s+|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')
      |(?P<skip2>\#\s*(?:include|if|ifdef|ifndef|endif|undef)[^\n]*)
      |(?P<define>\#\s*define\s+\w+)
      |(?P<number>0[xX][0-9a-fA-F]+[uUlL]*|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?[fFuUlL]*)
      |(?P<word>[A-Za-z_]\w*)
      |(?P<sign>->|\+\+|--|&&|\|\||<<=|>>=|<<|>>|[-+*/%&|<>=!]=|.)""",
    re.VERBOSE | re.DOTALL,
)

RELATIONAL = {
    "<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"),
    "==": ("!=",), "!=": ("==",), "&&": ("||",), "||": ("&&",),
}  # fmt: skip
ARITHMETIC = {
    "+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "%": ("*",), "&": ("|",), "|": ("&",),
    "+=": ("-=",), "-=": ("+=",), "*=": ("/=",), "/=": ("*=",), "|=": ("&=",), "&=": ("|=",), "++": ("--",), "--": ("++",),
}  # fmt: skip
CLAMPS = ("f_clamp", "f_max")  # of their arguments the first is what they bound
TYPES = re.compile(r"(?:\w+_t|const|static|float|int|unsigned|bool|char|void|double|struct|enum|typedef|extern)$")
NOT_DELETED = ("case", "default", "do", "while", "for", "switch", "else", "_Static_assert")


@dataclass(frozen=True)
class Token:
    kind: str
    text: str
    start: int
    end: int


@dataclass(frozen=True)
class Mutant:
    kind: str
    start: int  # the text from here
    end: int  # to here
    new: str  # becomes this

    def of(self, text: str) -> str:
        return text[: self.start] + self.new + text[self.end :]


def tokens(text: str) -> list[Token]:
    found = (Token(m.lastgroup, m.group(), m.start(), m.end()) for m in TOKEN.finditer(text))
    return [t for t in found if not t.kind.startswith("skip")]


def closing(ts: list[Token], i: int) -> int:
    """The index of what closes the bracket at i."""
    depth = 0
    for j in range(i, len(ts)):
        depth += ts[j].text in ("(", "[", "{")
        depth -= ts[j].text in (")", "]", "}")
        if depth == 0:
            return j
    return len(ts) - 1


def joins(ts: list[Token], i: int) -> bool:
    """Whether the sign at i stands between two operands."""
    before = ts[i - 1]
    return before.kind == "number" or before.text in (")", "]") or (
        before.kind == "word" and before.text != "return" and not TYPES.match(before.text)
    )  # fmt: skip


def other_numbers(text: str) -> list[str]:
    digits = text.rstrip("fFuUlL")
    suffix = text[len(digits) :]
    if digits[:2] in ("0x", "0X"):
        return [f"{int(digits, 16) ^ 1:#x}{suffix}"]
    if not re.search(r"[.eE]", digits):
        return [f"{int(digits) + by}{suffix}" for by in (-1, 1) if int(digits) + by >= 0]
    if float(digits) == 0.0:
        return [f"1.0{suffix}"]
    # A tenth less, a tenth more; an order of magnitude where that is all that is said.
    factors = (0.1, 10.0) if re.fullmatch(r"1(\.0*)?e[+-]?\d+", digits) else (0.9, 1.1)
    scaled = (f"{float(digits) * by:.9g}" for by in factors)
    return [(x if re.search(r"[.e]", x) else f"{x}.0") + suffix for x in scaled]


def of_numbers(ts: list[Token]) -> list[Mutant]:
    return [Mutant("constant", t.start, t.end, new) for t in ts if t.kind == "number" for new in other_numbers(t.text)]


def of_signs(ts: list[Token]) -> list[Mutant]:
    found = []
    for i, t in enumerate(ts):
        if t.kind != "sign" or i == 0:
            continue
        found += [Mutant("relational", t.start, t.end, new) for new in RELATIONAL.get(t.text, ())]
        if t.text in ("++", "--") or joins(ts, i):
            found += [Mutant("arithmetic", t.start, t.end, new) for new in ARITHMETIC.get(t.text, ())]
        elif t.text == "-":
            found.append(Mutant("negation", t.start, t.end, ""))
        if t.text == "!":
            found.append(Mutant("negation", t.start, t.end, ""))
    return found


def of_conditions(text: str, ts: list[Token]) -> list[Mutant]:
    found = []
    for i, t in enumerate(ts[:-1]):
        if t.text in ("if", "while") and ts[i + 1].text == "(":
            start, end = ts[i + 1].end, ts[closing(ts, i + 1)].start
            found.append(Mutant("negation", start, end, f"!({text[start:end]})"))
    return found


def of_clamps(text: str, ts: list[Token]) -> list[Mutant]:
    found = []
    for i, t in enumerate(ts[:-1]):
        if t.text not in CLAMPS or ts[i + 1].text != "(" or TYPES.match(ts[i - 1].text):
            continue
        j = i + 2
        while ts[j].text != ",":
            j = closing(ts, j) + 1 if ts[j].text in ("(", "[", "{") else j + 1
        found.append(Mutant("removed clamp", t.start, ts[closing(ts, i + 1)].end, f"({text[ts[i + 2].start:ts[j].start]})"))
    return found


def statement_end(ts: list[Token], i: int) -> int | None:
    """The index of the semicolon that ends the statement at i; none where a block comes first."""
    while i < len(ts) and ts[i].text not in (";", "{", "}"):
        i = closing(ts, i) + 1 if ts[i].text in ("(", "[") else i + 1
        if i < len(ts) and ts[i].text == "{" and ts[i - 1].text in ("=", ")") and ts[i - 2].kind != "define":
            compound = ts[i - 1].text == "=" or ts[i - 2].text.endswith("_t")
            i = closing(ts, i) + 1 if compound else i
    return i if i < len(ts) and ts[i].text == ";" else None


def of_statements(ts: list[Token]) -> list[Mutant]:
    found, blocks, brackets = [], 0, 0
    for i, t in enumerate(ts[:-1]):
        blocks += (t.text == "{") - (t.text == "}")
        brackets += (t.text == "(") - (t.text == ")")
        opens = t.text in (";", "{", "}", "else") or (t.text == ")" and heads(ts, i)) or (t.text == ":" and labels(ts, i))
        first = ts[i + 1]
        if blocks == 0 or brackets > 0 or not opens:
            continue
        if first.kind != "word" or TYPES.match(first.text) or first.text in NOT_DELETED:
            continue
        end = statement_end(ts, i + 1)
        if end is not None:
            found.append(Mutant("deleted statement", first.start, ts[end].end, ";"))
    return found


def labels(ts: list[Token], i: int) -> bool:
    """Whether the colon at i ends a label of a switch."""
    return ts[i - 1].text == "default" or ts[i - 2].text == "case"


def heads(ts: list[Token], i: int) -> bool:
    """Whether the bracket closed at i is the head of an if or a loop."""
    depth = 0
    for j in range(i, 0, -1):
        depth += (ts[j].text == ")") - (ts[j].text == "(")
        if depth == 0:
            return ts[j - 1].text in ("if", "while", "for")
    return False


def mutants(text: str) -> list[Mutant]:
    """All mutants of a file, in the order of their places."""
    ts = tokens(text)
    found = of_numbers(ts) + of_signs(ts) + of_conditions(text, ts) + of_clamps(text, ts) + of_statements(ts)
    return sorted(found, key=lambda m: (m.start, m.end, m.kind, m.new))
