"""The JSON Schemas that ship, one for each document: python -m tests.support.write_schemas."""

import json
from pathlib import Path

from equipoise.app.text import json_document, json_lists, json_results, json_torque
from equipoise.app.text.json_shape import Kind, name_of

DIALECT = "https://json-schema.org/draft/2020-12/schema"
FOLDER = Path(json_document.__file__).parent / "schemas"


def declared() -> dict[str, Kind]:
    """Return every document that is declared, by its name."""
    kinds = [kind for module in (json_document, json_lists, json_results, json_torque)
             for kind in vars(module).values() if isinstance(kind, Kind)]  # fmt: skip
    return {name_of(kind): kind for kind in kinds if "schema" in kind.schema.get("properties", ())}


def file_of(name: str) -> str:
    """Return the file of a schema: equipoise/balance/2 is in balance-2.json."""
    return name.removeprefix("equipoise/").replace("/", "-") + ".json"


def json_schema(kind: Kind) -> dict[str, object]:
    """Return the JSON Schema of a document."""
    return {"$schema": DIALECT, "title": name_of(kind), **kind.schema}


def schema_files() -> dict[str, str]:
    """Return the text of every file, as the declarations have it."""
    return {
        file_of(name): json.dumps(json_schema(kind), indent=1) + "\n"
        for name, kind in declared().items()
    }


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for name, text in schema_files().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
