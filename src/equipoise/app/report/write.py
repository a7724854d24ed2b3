"""A run put down in a folder: figures, report, JSON; all of them or none."""

from dataclasses import replace
from pathlib import Path

from equipoise.app.figures.base.files import rendered
from equipoise.app.report import logbook_entry
from equipoise.app.report.build import report
from equipoise.app.report.html import Drawings, html
from equipoise.app.report.pdf import can_set, pdf, png
from equipoise.app.report.run_record import Output, RunRecord
from equipoise.app.report.saved_report import DOCUMENT, saved_document, saved_drawing
from equipoise.app.text.blocks import Document, printed, text_of_document
from equipoise.app.text.json_document import dump
from equipoise.io.documents.run_folder import announce
from equipoise.io.files.atomic_file import write_folder

Files = dict[str, str | bytes]


def write_output(output: Output, folder: Path) -> list[Path]:
    """Write figures, the report (HTML, PDF, its blocks) and the JSON document; return the paths.

    What a logbook keeps comes too: testbed, recording, and the entry at last.
    """
    record, kept = output.record(), Files()
    if output.logged is not None:
        kept = logbook_entry.files_of(output.logged, record, folder.name)
        record = replace(record, origin={**record.origin, **logbook_entry.hashes(kept)})
    document: Files = {f"{output.name}.json": dump(output.document) + "\n"}
    paths = write_folder(folder, files_of(record) | document | kept)
    if output.logged is not None:
        announce(folder)
    return paths


def files_of(record: RunRecord) -> Files:
    """Return figures and report as files of a folder; without typst there is no PDF."""
    drawings = {p.name: rendered(p.figure, "svg") for p in (*record.step_figures, *record.figures)}
    figures = {place(name): drawing for name, drawing in drawings.items()}
    document = report(record)
    made = {DOCUMENT: text_of_document(document), **set_document(document, drawings)}
    return {**figures, **record.files, **made}


def set_document(document: Document, drawings: Drawings) -> Files:
    """Return report.html and, with typst, report.pdf."""
    document = printed(document)
    files: Files = {"report.html": html(document, drawings)}
    return files | {"report.pdf": pdf(document, drawings)} if can_set() else files


def set_again(folder: Path, as_png: bool = False) -> list[Path]:
    """Write the report of a run anew from its blocks and figures, and return the paths.

    With ``as_png`` each figure is written as a picture too. Raises InputError if they are not
    there, or are not what a run writes.
    """
    document = saved_document(folder)
    drawings = {name: saved_drawing(folder, folder / place(name)) for name in document.figures}
    pictures = {place(name, "png"): png(drawings[name]) for name in drawings} if as_png else {}
    return write_folder(folder, set_document(document, drawings) | pictures)


def place(name: str, kind: str = "svg") -> str:
    """Return where a figure stands in the folder of a run."""
    return f"figures/{name}.{kind}"
