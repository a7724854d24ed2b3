"""The report's own scripts and styles, and how they are packed."""

import base64
import gzip
import json
import re
from pathlib import Path

from equipoise.app.report import scripts
from equipoise.app.text.blocks import Document, Paragraph, Section
from equipoise.app.text.charts import Chart, Panel, Rows

OWN = sorted(Path(str(scripts.OWN)).iterdir())
MODULE_LINES = 250
CHART = Chart(
    "one", "</script><b>", (Panel("p", "um", (Rows(("x",), (0.0, 1.0), ((2.0, None),)),)),)
)


def unpacked(*blocks):
    packed = scripts.packed(Document("t", "p", (Section("", blocks),)))
    return json.loads(gzip.decompress(base64.b64decode(packed)))


def test_modules_are_short_and_say_what_they_are():
    texts = {path.name: path.read_text(encoding="utf-8") for path in OWN}
    assert len(texts) > 5
    assert [name for name, text in texts.items() if not text.startswith("/*")] == []
    assert [n for n, text in texts.items() if len(text.splitlines()) > MODULE_LINES] == []
    assert [n for n, text in texts.items() if re.search(r"https?://|url\(|@import", text)] == []


def test_each_module_stands_after_those_that_it_imports():
    found = unpacked(CHART)
    before = set()
    for name, text in found["modules"]:
        assert set(re.findall(r'"module:([^"]+)"', text)) <= before
        before.add(name)
    assert set(found["first"]) <= before
    assert not any("three" in name for name in before)  # without a replay


def test_numbers_come_through_as_they_are():
    (name, text), *_ = unpacked(CHART)["modules"]
    assert name == scripts.DATA
    data = json.loads(text.removeprefix("export const blocks = ").removesuffix(";"))
    assert data["one"]["panels"][0]["rows"][0]["columns"] == [[2.0, None]]
    assert data["one"]["caption"] == "</script><b>"


def test_a_report_without_charts_carries_no_scripts():
    assert scripts.packed(Document("t", "p", (Section("", (Paragraph("x"),)),))) == ""
