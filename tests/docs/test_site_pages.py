"""Pages of the site that are written from the code, and what is done to those of `docs/`."""

import os
import re

import equipoise
from docs.site.access import mended
from docs.site.card_pages import card_pages
from docs.site.command_pages import command_pages
from docs.site.gathered import FROM_ROOT, ROOT, from_root, gathered, write_changed
from docs.site.linked_names import page_named
from docs.site.python_pages import python_pages
from docs.site.schema_pages import schema_pages
from docs.site.schema_tables import kind, sections
from equipoise.app.cli import GROUPS, app

MOST_WORDS = 1200  # of README: what, picture, install, two commands, ten lines, where next
SCHEMA = {
    "$defs": {
        "part": {
            "type": "object",
            "description": "A part.",
            "properties": {"mass_kg": {"type": "number"}},
        }
    },
    "properties": {
        "name": {"type": "string", "description": "of a | b <c>"},
        "parts": {"type": "array", "items": {"$ref": "#/$defs/part"}},
        "share": {"type": "number", "minimum": 0, "exclusiveMaximum": 1, "default": 0.5},
        "by_name": {"type": "object", "additionalProperties": {"$ref": "#/$defs/part"}},
    },
    "required": ["name"],
}


def test_readme_is_short():
    words = (ROOT / "README.md").read_text(encoding="utf-8").split()
    assert 300 < len(words) <= MOST_WORDS


def test_every_command_has_a_page_with_all_of_its_options():
    pages = dict(command_pages())
    listed = pages["reference/commands/index.md"]
    every = [command for commands in GROUPS.values() for command in commands]
    names = [n for n in app if n[0] != "-" and app[n].default_command in every]
    assert len(names) == len(every)
    for name in names:
        page = pages[f"reference/commands/{name}.md"]
        assert page.startswith(f"# equipoise {name}\n")
        assert re.search(rf"^equipoise {name}( |$)", page, re.MULTILINE), name
        assert f"[`{name}`]({name}.md)" in listed
        options = {
            option
            for argument in app[name].assemble_argument_collection()
            if argument.parameter.show is not False
            for option in argument.names[:1]
            if option.startswith("--")
        }
        assert options <= set(re.findall(r"--[a-z][a-z0-9-]*", page)), name


def test_a_usage_line_has_the_programs_name_alone():
    """Cyclopts takes the name of the program that runs, which is Sphinx or pytest here."""
    page = dict(command_pages())["reference/commands/identify.md"]
    assert "\nequipoise identify --testbed STR [OPTIONS] FILE" in page


def test_every_public_name_has_a_page():
    pages = dict(python_pages())
    for name in set(equipoise.__all__) - {"__version__"}:
        assert f"equipoise.{name}\n" in pages[f"reference/python/{name}.md"]
        assert f"[`eq.{name}`]({name}.md)" in pages["reference/python/index.md"]


def test_cards_and_columns_are_listed():
    pages = dict(card_pages())
    assert all(f"## `{name}`" in pages["reference/methods.md"] for name in equipoise.methods())
    assert all(f"## `{name}`" in pages["reference/laws.md"] for name in equipoise.laws())
    files = pages["reference/recording-files.md"]
    assert "`omega_x_rad_s`" in files
    assert "`wheel_NAME_rad_s`" in files
    assert "| mcap | `.mcap` | yes | yes |" in files


def test_schemas_are_tables():
    found = "\n".join(sections(SCHEMA))
    assert "| `name` | string | yes | of a \\| b &lt;c> |" in found
    assert "| `parts` | array of object |  |  |" in found
    assert "| `share` | number >= 0, &lt; 1 |  | default 0.5 |" in found
    assert (
        "## `parts[]`\n\nA part.\n\n| key | type |\n| --- | --- |\n| `mass_kg` | number |" in found
    )
    assert "## `by_name.NAME`\n" in found


def test_kinds_are_named():
    assert kind({"const": 3}, {}) == "3"
    assert kind({"enum": ["a", "b"]}, {}) == "`a`, `b`"
    assert kind({"type": ["number", "null"]}, {}) == "number or null"
    three = {"type": "array", "prefixItems": [{"type": "number"}] * 3}
    assert kind({"anyOf": [three, {"type": "null"}]}, {}) == "3 x number or null"
    assert kind({"type": "object", "additionalProperties": {"type": "string"}}, {}) == (
        "object of string"
    )


def test_every_document_and_file_is_described():
    pages = dict(schema_pages())
    assert "| `covariance` |" in pages["reference/documents/estimate-1.md"]
    assert "| `tilt_limit_deg` |" in pages["reference/testbed-file.md"]
    assert "| `lab_up` |" in pages["reference/column-map.md"]


def test_links_of_pages_from_the_root_lead_to_the_site():
    text = "[a](docs/laws.md) [b](SECURITY.md#report) [c](https://x.org) `docs/laws.md` [d](#here)"
    assert from_root(text) == (
        "[a](../laws.md) [b](../project/reporting-security-faults.md#report) [c](https://x.org) "
        "`docs/laws.md` [d](#here)"
    )


def test_pages_are_gathered_without_the_program():
    found = dict(gathered())
    assert set(FROM_ROOT.values()) <= set(found)
    assert {"index.md", "start.md", "decisions/0001-numba-for-hot-kernels.md"} <= set(found)
    assert not [place for place in found if place.startswith("site/")]


def test_names_of_pages_are_known():
    assert page_named("docs/decisions/0001-numba.md") == "decisions/0001-numba"
    assert page_named("CONTRIBUTING.md") == "project/contributing"
    assert page_named("docs/figures/rooms.svg") is None
    assert page_named("my docs/laws.md") is None


def test_what_is_unchanged_keeps_its_time(tmp_path):
    write_changed(tmp_path, {"a.md": b"a", "b/c.md": b"c", "old.md": b""})
    for place in ("a.md", "b/c.md"):
        os.utime(tmp_path / place, (1000.0, 1000.0))
    write_changed(tmp_path, {"a.md": b"a", "b/c.md": b"other"})
    assert (tmp_path / "a.md").stat().st_mtime == 1000.0
    assert (tmp_path / "b/c.md").stat().st_mtime > 1000.0
    assert (tmp_path / "b/c.md").read_bytes() == b"other"
    assert not (tmp_path / "old.md").exists()


def test_faults_that_keep_people_out_are_mended():
    assert mended("<pre>x</pre>") == '<pre tabindex="0">x</pre>'
    assert mended('<div class="table-wrapper a">') == '<div tabindex="0" class="table-wrapper a">'
    assert 'aria-level="2"' in mended('<p class="caption" role="heading">')
    signature = "f(<dl>\n<dd><em>a</em>,</dd>\n<dd><em>b</em>,</dd>\n</dl>)"
    assert mended(signature) == (
        'f(<span class="parameters"><span class="parameter"><em>a</em>,</span>\n'
        '<span class="parameter"><em>b</em>,</span>\n</span>)'
    )
    glossary = "<dl><dt>word</dt><dd>meaning</dd></dl>"
    assert mended(glossary) == glossary
