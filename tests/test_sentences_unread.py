"""No program reads a sentence to decide: it reads a code.

A sentence is what is named as one (``PROSE``), or a name to which such a thing was given in the
same function. Compared, searched, split, matched or used as a key, it decides; joined, shown or
stored, it does not.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE, VERIFICATION = ROOT / "src" / "equipoise", ROOT / "verification"
PROSE = {"sentence", "sentences", "template", "note", "notes", "remark", "remarks"}
READING = {
    "startswith", "endswith", "split", "rsplit", "partition", "rpartition", "splitlines", "find",
    "rfind", "index", "rindex", "count", "removeprefix", "removesuffix", "strip", "lstrip",
    "rstrip", "lower", "upper", "casefold",
}  # fmt: skip
MATCHING = {"match", "search", "fullmatch", "findall", "finditer", "sub", "split", "get"}
LAYOUT = {
    ("app/console/terminal.py", "complain"),  # joins the lines of an error to one
    ("onboard/sources/filled.py", "filled"),  # placeholders of files in C
}
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)


def is_prose(node, given):  # noqa: PLR0911 - a case each
    """Say whether an expression is a sentence, or made of one."""
    match node:
        case ast.Attribute():
            return node.attr in PROSE or (node.attr not in READING and is_prose(node.value, given))
        case ast.Name():
            return node.id in PROSE | given
        case ast.JoinedStr():
            return any(is_prose(part, given) for part in node.values)
        case ast.FormattedValue(value=part) | ast.Subscript(value=part):
            return is_prose(part, given)
        case ast.Call(func=ast.Attribute(value=part)):
            return is_prose(part, given)
        case ast.BinOp(left=one, right=other):
            return is_prose(one, given) or is_prose(other, given)
    return False


def given_in(tree):
    """Return the names to which a sentence is given, anywhere in a function or module."""
    given = set[str]()
    for _ in range(3):  # names given to names
        for node in ast.walk(tree):
            pairs = []
            if isinstance(node, ast.Assign):
                pairs = [(target, node.value) for target in node.targets]
            elif isinstance(node, ast.NamedExpr | ast.AnnAssign) and node.value is not None:
                pairs = [(node.target, node.value)]
            elif isinstance(node, ast.For | ast.comprehension):
                pairs = [(node.target, node.iter)]
            for target, value in pairs:
                if isinstance(target, ast.Name) and is_prose(value, given):
                    given.add(target.id)
    return given


def is_reading(node, given):
    """Say whether an expression decides by a sentence."""
    if isinstance(node, ast.Compare):
        sides = [node.left, *node.comparators]
        if all(isinstance(op, ast.Is | ast.IsNot) for op in node.ops):
            return False
        return any(is_prose(side, given) for side in sides)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        if node.func.attr in READING and is_prose(node.func.value, given):
            return True
        return node.func.attr in MATCHING and any(is_prose(a, given) for a in node.args)
    if isinstance(node, ast.Subscript):
        return is_prose(node.slice, given)
    return isinstance(node, ast.Match) and is_prose(node.subject, given)


def readings(source):
    """Return the lines in which a program reads a sentence, with the function's name."""
    tree = ast.parse(source)
    scopes = [node for node in ast.walk(tree) if isinstance(node, FUNCTIONS)]
    found = set[tuple[str, int]]()
    for scope in scopes:
        given = given_in(scope)
        name = getattr(scope, "name", "lambda")
        found |= {(name, n.lineno) for n in ast.walk(scope) if is_reading(n, given)}
    inside = {line for _, line in found}
    found |= {
        ("", node.lineno)
        for node in ast.walk(tree)
        if is_reading(node, set()) and node.lineno not in inside
    }
    return found


@pytest.mark.parametrize(
    "source",
    [
        # What was found in this package, and why this test is here.
        "def warns(e):\n    text = e.outcome.sentence\n    return any(w in text for w in WORDS)",
        "def late(step):\n    return SPENT in step.sentence",
        "def said(quiet):\n    return quiet.sentence.split(' has ')[0]",
        "def style(sheet):\n    return [bad.get(r.split(':')[0]) for r in sheet.remarks]",
        "def mended(r):\n    return [n for n in r.notes if ' gap' not in n]",
        # Its relatives.
        "def f(v):\n    return v.sentence.startswith('Passed')",
        "def f(v):\n    return v.sentence == 'Passed.'",
        "def f(v):\n    return re.search('trust', v.sentence)",
        "def f(v):\n    return STYLES[v.sentence]",
        "def f(v):\n    match v.sentence:\n        case 'Passed.':\n            return 1",
        "def f(v):\n    if (text := v.outcome.sentence) and 'x' in text:\n        return 1",
        "def f(v):\n    return 'x' in f'{v.sentence}.'",
        "def f(v):\n    return 'x' in v.sentence[:9]",
        "GOOD = 'trust' in RESULT.sentence",
    ],
)
def test_a_program_that_reads_a_sentence_is_found_out(source):
    assert readings(source)


@pytest.mark.parametrize(
    "source",
    [
        "def f(v):\n    return f'{v.method}: {v.outcome.sentence}'",
        "def f(v):\n    return v.sentence if v.verdict is not None else ''",
        "def f(vs):\n    return ' '.join(v.sentence for v in vs)",
        "def f(v):\n    return v.code == 'passed' or v.name.startswith('com')",
    ],
)
def test_a_program_that_shows_a_sentence_is_let_be(source):
    assert not readings(source)


@pytest.mark.parametrize("room", [PACKAGE, VERIFICATION], ids=["package", "verification"])
def test_no_program_reads_a_sentence(room):
    found = [
        f"{where}:{line} {function}"
        for path in sorted(room.rglob("*.py"))
        for where in [path.relative_to(room).as_posix()]
        for function, line in sorted(readings(path.read_text(encoding="utf-8")))
        if (where, function) not in LAYOUT
    ]
    assert found == []


READING_JS = re.compile(
    r"\b(sentence|note|trip)\b\s*(?:[!=]==?|\.(?:includes|startsWith|endsWith|match|split|indexOf|"
    r"search|replace|toLowerCase)\()|\[[\w.]*\bsentence\]"
)


@pytest.mark.parametrize(
    ("line", "reads"),
    [
        ("if (step.sentence.includes('Passed')) return;", True),
        ("const mood = MOODS[step.sentence];", True),
        ('if (state.note === "over") stop();', True),
        ('textIn("span", step.sentence)', False),
        ("BADGES[step.outcome]", False),
    ],
)
def test_a_page_that_reads_a_sentence_is_found_out(line, reads):
    assert bool(READING_JS.search(line)) == reads


def test_no_page_reads_a_sentence():
    pages = sorted((PACKAGE / "app" / "dashboard" / "static").glob("*.js"))
    assert pages
    texts = {page.name: page.read_text(encoding="utf-8") for page in pages}
    assert [name for name, text in texts.items() if READING_JS.search(text)] == []
