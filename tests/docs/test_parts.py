"""The parts file of docs/parts.md is read, and gives what the page says of it."""

from pathlib import Path

from equipoise.app.api.inertia import inertia
from equipoise.io.documents.parts_file import parse_parts
from equipoise.model.mass_budget import DIMENSIONS
from equipoise.model.outcome import Trust
from tests.docs.test_examples import blocks

PAGE = (Path(__file__).parents[2] / "docs" / "parts.md").read_text(encoding="utf-8")


def test_the_pages_example_sums_to_a_body_that_its_swings_confirm():
    (toml,) = [block.text for block in blocks(PAGE) if block.kind == "toml"]
    found = inertia(parse_parts(toml, "parts.md"))
    assert found.estimate.outcome.trust is Trust.TRUSTWORTHY
    assert found.is_whole
    assert [share.name for share in found.shares[:2]] == ["electronics", "base plate"]
    assert len(found.checks) == 2


def test_the_page_has_every_shape():
    assert all(f"| `{shape}` |" in PAGE for shape in DIMENSIONS)
