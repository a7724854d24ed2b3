"""A run put down in a folder: figures, report, JSON; all of them or none."""

from pathlib import Path

from equipoise.app.account import Account
from equipoise.app.outputs import rendered
from equipoise.app.report import report
from equipoise.app.views_json import View, dump
from equipoise.io.whole_folder import write_folder


def write_account(account: Account, document: View, name: str, folder: Path) -> list[Path]:
    """Write figures (PNG), report.html and ``name``.json, and return their paths."""
    images = {picture.name: rendered(picture.figure) for picture in account.pictures}
    files: dict[str, str | bytes] = {f"{key}.png": image for key, image in images.items()}
    files |= {"report.html": report(account, images), f"{name}.json": dump(document) + "\n"}
    return write_folder(folder, files)
