"""``run.json``: what a logbook knows of the run in whose folder it stands."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from pydantic import ConfigDict, TypeAdapter, with_config

from equipoise.io.documents.json_document import read_document
from equipoise.io.documents.run_folder import A_RUN
from equipoise.model.errors import InputError
from equipoise.model.logged_run import RUN, LoggedRun


@with_config(ConfigDict(ser_json_inf_nan="strings"))  # JSON has no infinite number
@dataclass(frozen=True, slots=True)
class _Document:
    run: LoggedRun
    schema: Literal["equipoise/run/1"] = "equipoise/run/1"


_DOCUMENT = TypeAdapter(_Document)


def text_of_run(run: LoggedRun) -> str:
    """Return the file's text; what is infinite or not a number stands there as a string."""
    return _DOCUMENT.dump_json(_Document(run), indent=1).decode()


def read_run(folder: Path) -> LoggedRun:
    """Return the run of a folder, by the name that the folder has now.

    Raises InputError if the file is not there, or if it is not one.
    """
    path = folder / RUN
    document = read_document(_DOCUMENT.validate_json, path, A_RUN, "a run, equipoise/run/1")
    for p in (*document.run.parameters, *document.run.standing):
        if p.sd < 0:
            raise InputError(f"{path}: sd of {p.name}", f"{p.sd:g}", "one that is not negative")
    return replace(document.run, name=folder.name)
