"""A run put down in a folder: figures, report, JSON; all of them or none."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from equipoise.app.figures.base.files import rendered
from equipoise.app.report import logbook_entry
from equipoise.app.report.build import report
from equipoise.app.report.html import html
from equipoise.app.report.pdf import can_set, pdf
from equipoise.app.report.run_record import Account
from equipoise.app.text.blocks import Page, page_of_text, text_of_page, typeset_page
from equipoise.app.text.json_document import View, dump
from equipoise.io.documents.run_folder import A_RUN
from equipoise.io.files.atomic_folder import write_folder
from equipoise.io.files.source_file import read_bytes

Files = dict[str, str | bytes]
Images = Mapping[str, Mapping[str, bytes]]  # by kind of file and by name
KINDS = ("png", "svg")
PAGE = "report.json"


def write_account(account: Account, document: View, name: str, folder: Path) -> list[Path]:
    """Write figures, the report (HTML, PDF, its blocks) and ``name``.json; return their paths."""
    return write_folder(folder, files_of(account) | {f"{name}.json": dump(document) + "\n"})


def write_run(
    account: Account, document: View, name: str, kept: logbook_entry.Kept, folder: Path
) -> list[Path]:
    """Write the same, with what a logbook needs: testbed, recording, and the entry at last."""
    beside = logbook_entry.files_of(kept, account, folder.name)
    traced = replace(account, origin={**account.origin, **logbook_entry.hashes(beside)})
    files = files_of(traced) | {f"{name}.json": dump(document) + "\n"}
    return write_folder(folder, files | beside)


def files_of(account: Account) -> Files:
    """Return figures and report as files of a folder; without typst there is no PDF."""
    pictures = [*account.step_pictures.values(), *account.pictures]
    images = {kind: {p.name: rendered(p.figure, kind) for p in pictures} for kind in KINDS}
    page = report(account)
    figures = {place(name, kind): images[kind][name] for kind in KINDS for name in images[kind]}
    return {**figures, PAGE: text_of_page(page), **set_page(page, images)}


def set_page(page: Page, images: Images) -> Files:
    """Return report.html and, with typst, report.pdf."""
    printed = typeset_page(page)
    files: Files = {"report.html": html(printed, images["png"])}
    return files | {"report.pdf": pdf(printed, images["svg"])} if can_set() else files


def set_again(folder: Path) -> list[Path]:
    """Write the report of a run anew from its blocks and figures, and return the paths.

    Raises InputError if they are not there.
    """
    page = page_of_text(read_bytes(folder / PAGE, A_RUN), str(folder / PAGE))
    images = {k: {n: read_bytes(folder / place(n, k), A_RUN) for n in page.figures} for k in KINDS}
    return write_folder(folder, set_page(page, images))


def place(name: str, kind: str) -> str:
    """Return where a figure stands in the folder of a run."""
    return f"figures/{name}.{kind}"
