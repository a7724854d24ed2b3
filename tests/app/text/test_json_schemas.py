"""Each document has a JSON Schema that ships, says what is written, and knows SI units alone."""

import json
import re
from types import SimpleNamespace

import numpy as np
import pytest

from equipoise.app.text.json_shape import (
    MATRIX,
    NUMBER,
    TEXT,
    Key,
    document,
    fields,
    many,
    maybe,
    name_of,
    shape,
)
from tests.support.schema_check import faults
from tests.support.write_schemas import FOLDER, declared, json_schema, schema_files

# deg Celsius, hertz and a share are SI; a byte is no quantity of the SI.
NOT_SI = re.compile(
    r".*_(um2?|mm2?|cm|nm|km|um_min|mm_s|cm_s|deg|deg_s|rpm|mrad|g|mg|g_cm|kg_cm|min|h|ms|us|ns|"
    r"uT|nT|mT|mN_m|uN_m|uJ|percent|ppm|khz|l)"
)
every_document = pytest.mark.parametrize("kind", declared().values(), ids=name_of)


def keys_of(schema):
    """Yield every key that a schema names, however deep."""
    if isinstance(schema, dict):
        yield from schema.get("properties", {})
        for part in schema.values():
            yield from keys_of(part)
    if isinstance(schema, list):
        for part in schema:
            yield from keys_of(part)


def test_the_files_are_those_of_the_declarations():
    shipped = {path.name: path.read_text(encoding="utf-8") for path in FOLDER.iterdir()}
    assert shipped == schema_files(), "python -m tests.support.write_schemas"


@every_document
def test_no_key_ends_in_another_unit_than_one_of_the_si(kind):
    keys = set(keys_of(json_schema(kind)))
    assert "schema" in keys
    assert not [name for name in keys if NOT_SI.fullmatch(name)]


@pytest.mark.parametrize("name", ["com_um", "covariance_um2", "travel_mm", "start_deg", "hold_min"])
def test_another_unit_is_noticed(name):
    assert NOT_SI.fullmatch(name)


@pytest.mark.parametrize("name", ["com_m", "inertia_P_kg_m2", "rate_hz", "sum", "com", "time_s"])
def test_si_units_and_words_are_let_through(name):
    assert not NOT_SI.fullmatch(name)


@every_document
def test_a_document_says_what_it_is_and_in_which_version(kind):
    assert re.fullmatch(r"equipoise/[a-z_-]+/[1-9]\d*", name_of(kind))
    assert json_schema(kind)["required"][0] == "schema"


BODY = shape(
    *fields("name", TEXT),
    Key("com_m", maybe(MATRIX), lambda body: body.com),
    Key("note", TEXT, lambda body: body.note, optional=True),
)
MADE = document("equipoise/made/1", *fields("bodies", many(BODY)), *fields("size", NUMBER))


def made(**changes):
    body = SimpleNamespace(name="a", com=np.eye(2), note=None)
    return MADE.write({"bodies": [body], "size": 2.0} | changes)


def test_a_record_becomes_the_document_of_its_declaration():
    assert made() == {
        "schema": "equipoise/made/1",
        "bodies": [{"name": "a", "com_m": [[1.0, 0.0], [0.0, 1.0]]}],
        "size": 2.0,
    }
    other = SimpleNamespace(name="b", com=None, note="none")
    assert made(bodies=[other])["bodies"] == [{"name": "b", "com_m": None, "note": "none"}]


@pytest.mark.parametrize(
    ("spoiled", "said"),
    [
        (lambda d: d.pop("size"), ": no 'size'"),
        (lambda d: d.update(more=1), ": 'more' is not in the schema"),
        (lambda d: d.update(size="2"), ".size: '2', wanted ['number', 'null']"),
        (lambda d: d.update(schema="equipoise/made/2"), ".schema: 'equipoise/made/2', wanted"),
        (lambda d: d["bodies"][0].update(com_m=[["x"]]), ".bodies[0].com_m[0][0]: 'x', wanted"),
        (lambda d: d["bodies"][0].update(name=True), ".bodies[0].name: True, wanted string"),
    ],
)
def test_a_document_that_differs_from_its_schema_is_noticed(spoiled, said):
    wrong = json.loads(json.dumps(made()))
    assert not list(faults(wrong, json_schema(MADE)))
    spoiled(wrong)
    assert next(faults(wrong, json_schema(MADE))).startswith(said)
