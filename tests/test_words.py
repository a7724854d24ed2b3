"""What people read is in the field's English: no private words, sentences that can be read."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import equipoise

PACKAGE = Path(equipoise.__file__).parent
FORBIDDEN = frozenset(
    [
        "amid",
        "anew",
        "apart",
        "beforehand",
        "begun",
        "belief",
        "believed",
        "candour",
        "felt",
        "firmer",
        "foreseen",
        "heard",
        "lone",
        "mend",
        "mends",
        "nobody",
        "seek",
        "seeks",
        "somebody",
        "sought",
        "stranger",
        "strangers",
        "tell",
        "tells",
        "told",
        "unasked",
    ]
)
ALLOWED = ("cannot tell", "does not tell")  # a verdict's outcome; what a table does not show
SENTENCE = 4  # blanks at least, chosen: less is a name, a unit or a part of one
LONGEST = 40  # words of letters in a sentence that is put together from parts
MEAN = 18


def docstrings(tree: ast.AST) -> set[int]:
    """Return the nodes that are docstrings, and the texts within f-strings."""
    found = set[int]()
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef)
            and node.body
        ):
            first = node.body[0]
            if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
                found.add(id(first.value))
        if isinstance(node, ast.JoinedStr):
            found |= {id(part) for part in ast.walk(node) if part is not node}
    return found


def text_of(node: ast.AST) -> str:
    """Return the text of a string, with a number where a value is put in."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(v.value if isinstance(v, ast.Constant) else "7" for v in node.values)
    return ""


def sentences() -> Iterator[tuple[str, str]]:
    """Yield module and text of all that the program may say."""
    for path in sorted(PACKAGE.rglob("*.py")):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        aside = docstrings(tree)
        where = path.relative_to(PACKAGE).as_posix()
        for node in ast.walk(tree):
            text = "" if id(node) in aside else text_of(node)
            if text.count(" ") >= SENTENCE and "SELECT" not in text and "TABLE" not in text:
                yield where, text


def helps() -> Iterator[tuple[str, str]]:
    """Yield the texts of `--help`: docstrings of commands and of their options."""
    for folder in ("commands", "arguments"):
        for path in sorted((PACKAGE / "app" / folder).glob("*.py")):
            for node in ast.parse(path.read_text(encoding="utf-8")).body:
                if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name[0] != "_":
                    yield path.name, ast.get_docstring(node) or ""


def words(text: str) -> list[str]:
    """Return the words of a text, phrases that are allowed left out."""
    plain = text.lower()
    for phrase in ALLOWED:
        plain = plain.replace(phrase, "")
    return re.findall(r"[a-z][a-z'-]+", plain)


def test_no_text_has_a_private_word():
    every = [*sentences(), *helps()]
    assert len(every) > 1000
    found = {(where, word) for where, text in every for word in FORBIDDEN & set(words(text))}
    assert found == set()


def test_sentences_are_short():
    every = [part for _, text in sentences() for part in re.split(r"(?<=[.?:;]) ", text)]
    lengths = [len(words(part)) for part in every]
    assert [part for part, n in zip(every, lengths, strict=True) if n > LONGEST] == []
    assert sum(lengths) / len(lengths) < MEAN
