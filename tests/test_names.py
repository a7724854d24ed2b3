"""The field's words: no identifier and no file bears a private one (see ``docs/glossary.md``)."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
FOLDERS = ("src", "tests", "verification", "benchmarks")
SOURCES = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py"))
SCRIPTS = sorted((ROOT / "src/equipoise/app/dashboard/static").glob("*.js"))

PRIVATE = frozenset(
    [
        "apart",
        "ask",
        "asked",
        "asking",
        "asks",
        "belief",
        "beliefs",
        "believe",
        "believed",
        "believes",
        "beforehand",
        "candour",
        "far",
        "feel",
        "feels",
        "felt",
        "hear",
        "heard",
        "hearing",
        "hears",
        "lone",
        "look",
        "looked",
        "looking",
        "looks",
        "saw",
        "seen",
        "stranger",
        "strangers",
        "tell",
        "telling",
        "tells",
        "told",
    ]
)
# Names that other packages gave.
FOREIGN = {"LookupError", "strategy.ask", "strategy.tell", "file.tell", "lookAt"}

# File names that said nothing to an engineer of the field: today's names are in the glossary.
FORMER = frozenset(
    [
        "account",
        "aid",
        "apart",
        "asking",
        "at_terminal",
        "believed",
        "believed_model",
        "beforehand",
        "better",
        "bound_at_truth",
        "candour",
        "capacity",
        "change",
        "choices",
        "compiling",
        "condensed",
        "counter",
        "descent",
        "desk",
        "driven",
        "durable_file",
        "event_moments",
        "event_price",
        "event_spread",
        "eventful",
        "evolution",
        "exposure",
        "far_rows",
        "felt",
        "fitted",
        "followed_motion",
        "foresight",
        "good_moment",
        "guard",
        "hand_belief",
        "hand_session",
        "handing_over",
        "hanging",
        "hanging_masses",
        "heard",
        "held_out_rows",
        "held_values",
        "interruption",
        "keeper",
        "kept_bench",
        "knowledge",
        "led_motion",
        "logged",
        "lone_record",
        "look_over_hours",
        "metering",
        "momentum_ledger",
        "newest",
        "one_commander",
        "outer_bench",
        "own_process",
        "placed",
        "plain_model",
        "point_steps",
        "posing",
        "possible",
        "post",
        "promise",
        "proof",
        "quiet",
        "reachable",
        "replicates",
        "saturation",
        "seeking",
        "seen",
        "shooting",
        "sound_rows",
        "spreading",
        "stations",
        "strangers",
        "stretches",
        "telling",
        "told_events",
        "torque_colour",
        "tracker_onsets",
        "tracker_point",
        "tracker_update",
        "tracker_walk",
        "tracker_window",
        "unknowns",
        "untied_scale",
        "usual",
        "walk_size",
        "wandering",
        "warm",
        "watch",
        "watched_bench",
        "whole_file",
        "whole_folder",
        "whole_message",
    ]
)


@cache
def words(identifier: str) -> set[str]:
    """Return the words of an identifier in lower case."""
    parts = re.findall(r"[A-Z]?[a-z0-9]+|[A-Z0-9]+(?![a-z])", identifier)
    return {part.lower() for part in parts}


def identifiers(source: str) -> Iterator[tuple[int, str]]:
    """Yield line and name of every identifier, with what it belongs to; those of f-strings too."""
    tokens = list(tokenize.generate_tokens(io.StringIO(source).readline))
    for before, dot, token in zip(tokens, tokens[1:], tokens[2:], strict=False):
        if token.type == tokenize.NAME:
            owner = f"{before.string.lstrip('_')}." if dot.string == "." else ""
            yield token.start[0], owner + token.string
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FormattedValue):
            named = (each for each in ast.walk(node.value) if isinstance(each, ast.Name))
            yield from ((each.lineno, each.id) for each in named)


def private(source: str) -> list[tuple[int, str]]:
    """Return line and name of every identifier with a private word."""
    written = set(re.findall(r"[A-Za-z_]\w*", source))
    if not any(words(each) & PRIVATE for each in written):
        return []  # not in comments or texts either, and to take a source apart takes long
    return [
        (line, name)
        for line, name in identifiers(source)
        if name not in FOREIGN and words(name.rpartition(".")[2]) & PRIVATE
    ]


def script_identifiers(source: str) -> Iterator[tuple[int, str]]:
    """Yield line and name of every identifier of a script; comments and texts are left out."""
    bare = re.sub(r"/\*.*?\*/", lambda found: "\n" * found[0].count("\n"), source, flags=re.S)
    for number, line in enumerate(bare.splitlines(), 1):
        code = re.sub(r"\"[^\"]*\"|//.*", "", line)
        yield from ((number, name) for name in re.findall(r"[A-Za-z_]\w*", code))


def test_private_words_are_found_wherever_an_identifier_stands():
    source = (
        "from a import felt_torque as torque\n"
        "def run(*, so_far: int) -> None:\n"
        "    print(f'{believed}', torque.seen_at, strategy.tell)\n"
        "class LiveBelief: ...\n"
    )
    assert sorted(name for _, name in private(source)) == [
        "LiveBelief", "believed", "felt_torque", "so_far", "torque.seen_at",
    ]  # fmt: skip


def test_no_identifier_bears_a_private_word():
    found = [
        f"{path.relative_to(ROOT)}:{line} {name}"
        for path in SOURCES
        for line, name in private(path.read_text(encoding="utf-8"))
        if path != Path(__file__)
    ]
    assert found == []


def test_no_identifier_of_the_page_bears_a_private_word():
    found = [
        f"{path.name}:{line} {name}"
        for path in SCRIPTS
        for line, name in script_identifiers(path.read_text(encoding="utf-8"))
        if name not in FOREIGN and words(name) & PRIVATE
    ]
    assert found == []


def test_no_file_bears_a_former_or_private_name():
    stems = {path: path.stem.removeprefix("test_") for path in SOURCES}
    found = [
        str(path.relative_to(ROOT))
        for path, stem in stems.items()
        if stem in FORMER or words(stem) & PRIVATE
    ]
    assert found == []
