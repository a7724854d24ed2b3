"""The cards of methods and laws, and the columns of a recording, each as a page of tables."""

from collections.abc import Iterator, Mapping, Sequence

import equipoise as eq
from docs.site.schema_tables import text
from equipoise.app.views.card_views import law_pairs, method_pairs
from equipoise.io.columns.device_columns import UNITS
from equipoise.io.columns.native_columns import GROUPS, TIME
from equipoise.io.recording.format_registry import FORMATS

METHODS = """# Methods, one by one

These are the values of `equipoise identify --method`. [Estimation methods](../methods.md) compares
them.
"""
LAWS = """# Control laws, one by one

These are the values of `equipoise balance --law`. [Control laws](../laws.md) compares them.
"""
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
    found = {name: method_pairs(methods[name]) for name in methods}
    yield "reference/methods.md", "\n".join([METHODS, *_cards(found)])
    found = {name: law_pairs(laws[name]) for name in laws}
    yield "reference/laws.md", "\n".join([LAWS, *_cards(found)])
    yield "reference/recording-files.md", "\n".join([COLUMNS, *_columns(), *_formats()])


def _cards(cards: Mapping[str, Sequence[tuple[str, str]]]) -> Iterator[str]:
    """Yield a section for each card; its first pair is its name."""
    for name, pairs in cards.items():
        yield f"## `{name}`\n\n| property | value |\n|---|---|"
        yield from (f"| {key} | {text(value)} |" for key, value in pairs[1:])
        yield ""


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
