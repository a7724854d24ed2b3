"""The cards of methods and laws, and the columns of a recording, each as a page of tables."""

from collections.abc import Iterator, Sequence

import equipoise as eq
from docs.site.schema_tables import text
from equipoise.app.views.card_views import law_pairs, method_pairs
from equipoise.io.columns.device_columns import UNITS
from equipoise.io.columns.native_columns import GROUPS, TIME
from equipoise.io.recording.format_registry import FORMATS

COLUMNS = """# Recording files

These are the columns of a recording in Equipoise's own names, in every format. A cell is blank
where its channel has no row at that time. A table with other columns takes a
[column map](column-map.md); [Recordings](../recordings.md) explains which foreign files are read.

## Columns

| channel | columns |
|---|---|"""
NAMED = {"mass": "mm"} | {device: unit for device, (unit, _) in UNITS.items()}


def card_pages() -> Iterator[tuple[str, str]]:
    """Yield the pages by their paths in the site."""
    methods, laws = eq.methods(), eq.laws()
    method_cards = [(name, method_pairs(methods[name])) for name in methods]
    law_cards = [(name, law_pairs(laws[name])) for name in laws]
    yield (
        "reference/methods.md",
        _cards("Methods", "../methods.md", "`identify --method`", method_cards),
    )
    yield "reference/laws.md", _cards("Control laws", "../laws.md", "`balance --law`", law_cards)
    yield "reference/recording-files.md", "\n".join([COLUMNS, *_columns(), *_formats()])


def _cards(
    title: str, guide: str, option: str, cards: Sequence[tuple[str, Sequence[tuple[str, str]]]]
) -> str:
    lines = [f"# {title}, one by one\n", f"All that {option} takes. [The guide]({guide}) compares "
             "them.\n"]  # fmt: skip
    for name, pairs in cards:
        lines += [f"## `{name}`\n", "| property | value |", "|---|---|"]
        lines += [f"| {key} | {text(value)} |" for key, value in pairs[1:]]
        lines.append("")
    return "\n".join(lines)


def _columns() -> Iterator[str]:
    yield f"| time | `{TIME}` |"
    for channel, (names, _) in GROUPS.items():
        yield f"| {channel} | {', '.join(f'`{name}`' for name in names)} |"
    for kind, unit in NAMED.items():
        yield f"| {kind}, one column each | `{kind}_NAME_{unit}` |"


def _formats() -> Iterator[str]:
    yield "\n## Formats\n\n| format | suffixes | read | written |\n|---|---|---|---|"
    for each in FORMATS:
        suffixes = ", ".join(f"`{suffix}`" for suffix in each.suffixes) or "by content"
        yield f"| {each.name} | {suffixes} | yes | {'no' if each.write is None else 'yes'} |"
    yield ""
