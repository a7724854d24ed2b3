"""A JSON document read as a record: what does not fit is named with its place."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from equipoise.io.files.source_file import read_bytes
from equipoise.model.errors import InputError

Read = TypeVar("Read")


def read_document(validate: Callable[[bytes], Read], path: Path, file: str, document: str) -> Read:
    """Return the record of a file; ``validate`` is that of a pydantic adapter, for JSON.

    ``file`` and ``document`` state what is wanted: where the file cannot be read, and where its
    contents do not fit. Raises InputError for both.
    """
    try:
        return validate(read_bytes(path, file))
    except ValidationError as error:
        first = error.errors()[0]
        where = ": ".join((str(path), *map(str, first["loc"])))
        raise InputError(where, first["msg"], document) from error
