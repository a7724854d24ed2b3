"""Which characters a person sees; the others hide something, or act on what shows the text."""

import unicodedata


def is_visible(letter: str) -> bool:
    """Say whether a character is seen as such, blanks of any width among them.

    Control characters of both sets, changes of direction, characters of no width, separators of
    lines and paragraphs, lone surrogates and what no font has are not.
    """
    return letter.isprintable() or unicodedata.category(letter) == "Zs"


def is_all_visible(text: str) -> bool:
    """Say whether each character of a text is seen."""
    return text.isprintable() or all(map(is_visible, text))
