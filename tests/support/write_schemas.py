"""Write the shipped JSON Schemas anew: python -m tests.support.write_schemas."""

from equipoise.app.text.json_schemas import FOLDER, schema_files

if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for name, text in schema_files().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
