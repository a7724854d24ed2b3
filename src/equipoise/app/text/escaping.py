r"""What leaves the program as text, made harmless for the medium: one function a medium.

Names of files, columns, testbeds and runs are written by others. At a terminal an escape sequence
moves the cursor or renames the window, and a direction override turns a name round; a spreadsheet
runs a cell that begins with ``=``; a page runs a script. Whatever is no visible character is shown
as an escape such as ``\x1b``: nothing runs, and nothing vanishes.
"""

import html
import re
from collections.abc import Callable, Iterator
from typing import Any

from equipoise.model.visible_text import is_visible

KEPT = "\t"  # lays out our own texts, as line ends do
SURROGATES = range(0xDC80, 0xDD00)  # bytes of a file's name that are no UTF-8, as Python has them
RUN_BY_SPREADSHEETS = ("=", "+", "-", "@", "\t", "\r", "＝", "＋", "－", "＠")  # noqa: RUF001
NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?|[+-]?(inf|nan)")
NOT_IN_FILE_NAMES = re.compile(r"[^\w.]+")
LONGEST = 40  # letters of a name within a file's name, chosen
RESERVED = {
    "con",
    "prn",
    "aux",
    "nul",
    *(f"{port}{k}" for port in ("com", "lpt") for k in range(10)),
}
UNNAMED = "platform"


def for_terminal(text: str) -> str:
    """Return a text in which nothing but line ends and tabs is invisible or acts.

    All else (``visible_text``) becomes escapes.
    """
    return _by_lines(text, _visible)


def for_one_line(text: str) -> str:
    """Return the same in one line, as a sentence stands on a terminal or in a list."""
    return " ".join(for_terminal(text).split())


def for_json(text: str) -> str:
    """Return a JSON text that means the same, with JSON's escapes for what is not visible."""
    return _by_lines(text, _json_visible)


def for_csv_cell(cell: Any) -> Any:
    """Return a cell that no spreadsheet runs; numbers, and texts of plain numbers, stay.

    A text that would be a formula gets an apostrophe before it, which spreadsheets do not show.
    """
    if not isinstance(cell, str):
        return cell
    acts = cell.lstrip(" ").startswith(RUN_BY_SPREADSHEETS) and not NUMBER.fullmatch(cell)
    return ("'" if acts else "") + for_terminal(cell)


def for_html(text: str) -> str:
    """Return a text for an element or a quoted attribute of HTML."""
    return html.escape(for_terminal(text))


def for_figure(text: str) -> str:
    """Return a text for a figure, in one line; a dollar sign begins no formula there."""
    return for_one_line(text).replace("$", r"\$")


def for_typst(value: Any) -> Any:
    """Return what typst gets as data, its texts visible; typst never takes them as its code."""
    if isinstance(value, str):
        return for_terminal(value)
    if isinstance(value, dict):
        return {key: for_typst(each) for key, each in value.items()}  # pyright: ignore
    if isinstance(value, list | tuple):
        return [for_typst(each) for each in value]  # pyright: ignore
    return value


def texts_within(value: Any) -> Iterator[str]:
    """Yield each text within what typst would get."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict | list | tuple):
        for each in value.values() if isinstance(value, dict) else value:  # pyright: ignore
            yield from texts_within(each)


def for_file_name(name: str) -> str:
    """Return a name as one part of a file's name: letters, digits, points and dashes.

    It names no other folder, nothing hidden and no device of Windows.
    """
    plain = NOT_IN_FILE_NAMES.sub("-", name).lower().strip("-.")[:LONGEST].rstrip("-.")
    return UNNAMED if not plain or plain.split(".")[0] in RESERVED else plain


def _by_lines(text: str, visible: Callable[[str], str]) -> str:
    """Return a text letter by letter; documents are long, and most of their lines need nothing."""
    lines = text.split("\n")
    return "\n".join(t if t.isprintable() else "".join(map(visible, t)) for t in lines)


def _visible(letter: str) -> str:
    code = ord(letter)
    if letter in KEPT or is_visible(letter):
        return letter
    if code in SURROGATES:
        return f"\\x{code & 0xFF:02x}"
    return _escape(code)


def _escape(code: int) -> str:
    if code <= 0xFF:
        return f"\\x{code:02x}"
    return f"\\u{code:04x}" if code <= 0xFFFF else f"\\U{code:08x}"


def _json_visible(letter: str) -> str:
    """Return a letter of a JSON text; what is not visible stands within a string there."""
    if _visible(letter) == letter:
        return letter
    units = letter.encode("utf-16-be", "surrogatepass")
    pairs = (units[k : k + 2].hex() for k in range(0, len(units), 2))
    return "".join(f"\\u{pair}" for pair in pairs)
