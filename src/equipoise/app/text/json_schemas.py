"""The JSON Schemas that ship, one for each document: ``schemas/balance-2.json``."""

import json
from pathlib import Path

from equipoise.app.text.json_document import BALANCE, ESTIMATE, RECORDING
from equipoise.app.text.json_lists import (
    BUILDS,
    CHANNELS,
    COMPARE,
    COMPARE_LAWS,
    COMPARE_METHODS,
    DEVICES,
    LAWS,
    LOGBOOK,
    MASS_PROPERTIES,
    METHODS,
    REPRODUCE_LEE,
    RUNS_COMPARED,
)
from equipoise.app.text.json_results import ASSESS, DESIGN, OBSERVE, PLAN
from equipoise.app.text.json_shape import json_schema, name_of

FOLDER = Path(__file__).parent / "schemas"
DOCUMENTS = (ASSESS, BALANCE, BUILDS, CHANNELS, COMPARE, COMPARE_LAWS, COMPARE_METHODS, DESIGN,
             DEVICES, ESTIMATE, LAWS, LOGBOOK, MASS_PROPERTIES, METHODS, OBSERVE, PLAN, RECORDING,
             REPRODUCE_LEE, RUNS_COMPARED)  # fmt: skip


def file_of(name: str) -> str:
    """Return the file of a schema: equipoise/balance/2 is in balance-2.json."""
    return name.removeprefix("equipoise/").replace("/", "-") + ".json"


def schema_files() -> dict[str, str]:
    """Return the text of every file, as the declarations have it."""
    return {
        file_of(name_of(each)): json.dumps(json_schema(each), indent=1) + "\n" for each in DOCUMENTS
    }
