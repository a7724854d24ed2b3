"""What is said of a command line that cannot be understood, in one sentence."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from cyclopts import CycloptsError, MissingArgumentError

from equipoise.model.errors import InputError

WHAT = "that describes the platform, its sensors and its masses (`equipoise new` writes one)"


def wrong_use(error: CycloptsError) -> str:
    """Return the sentence: what is missing, or wrong, and how it is given."""
    name = "" if error.argument is None else error.argument.name
    if isinstance(error, MissingArgumentError) and name.strip("-").lower() == "testbed":
        words = error.root_input_tokens or ()
        return str(_no_testbed(" ".join(error.command_chain or ()), name, words))
    return f"{error} (equipoise --help lists the commands)"


def _no_testbed(command: str, name: str, words: Sequence[str]) -> InputError:
    """Return the error for a command without its testbed, which may stand without its option."""
    from equipoise.io.testbed.presets import preset_names

    presets = preset_names()
    listed = ", ".join(presets)
    if not name.startswith("-"):
        wanted = f"a file {WHAT}, such as 'equipoise {command} my.toml', or a preset: {listed}"
        return InputError(command, "no testbed", wanted)
    stray = _stray(words, presets)
    if stray is not None:
        return InputError(command, f"'{stray}' in the place of a recording", f"{name} {stray}")
    wanted = f"{name} my.toml, a file {WHAT}, or {name} and a preset: {listed}"
    return InputError(command, "no testbed", wanted)


def _stray(words: Sequence[str], presets: Sequence[str]) -> str | None:
    """Return the word that is a testbed by its name, and is no option's."""
    for before, word in pairwise(words):
        is_testbed = Path(word).suffix.lower() == ".toml" or word in presets
        if is_testbed and not before.startswith("-"):
            return word
    return None
