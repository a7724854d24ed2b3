"""Pages of what files hold: JSON documents, testbed files, column maps, plans."""

import json
from collections.abc import Iterator, Mapping
from importlib.resources import files
from typing import Any

from docs.site.schema_tables import sections
from equipoise.io.columns.column_map_file import MapFile
from equipoise.io.testbed.testbed import TestbedFile

DOCUMENTS = "reference/documents"
HEAD = """# JSON documents

`--json` prints one document, and a run folder keeps the same. Each names its schema and version:
`equipoise/estimate/1`. Numbers are in SI units; `null` stands for what is not finite. The schemas
are part of the package (`equipoise/app/text/schemas`).

"""
TOML = {
    "testbed-file": (
        "Testbed file",
        TestbedFile,
        "`equipoise new` writes a testbed file to start from, and [Platforms](../platform.md) "
        "explains it. These are all of its tables and keys.",
    ),
    "column-map": (
        "Column map",
        MapFile,
        "A column map says what the columns of your table hold: `--columns map.toml`. `equipoise "
        "import` writes one, and [Recordings](../recordings.md) explains it.",
    ),
}


def schema_pages() -> Iterator[tuple[str, str]]:
    """Yield the pages by their paths in the site."""
    schemas = dict(_documents())
    for name, schema in schemas.items():
        yield f"{DOCUMENTS}/{name}.md", _page(schema["title"], "", schema)
    tree = "\n".join(["```{toctree}", ":maxdepth: 1", "", *schemas, "```", ""])
    yield f"{DOCUMENTS}/index.md", HEAD + tree
    for name, (title, table, about) in TOML.items():
        yield f"reference/{name}.md", _page(title, f"{about}\n", table.model_json_schema())


def _documents() -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield each JSON document's name and schema."""
    folder = files("equipoise.app.text").joinpath("schemas")
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        yield entry.name.removesuffix(".json"), json.loads(entry.read_text(encoding="utf-8"))


def _page(title: str, about: str, schema: Mapping[str, Any]) -> str:
    return "\n".join([f"# {title}\n", about, *sections(schema)])
