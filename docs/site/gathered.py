"""Pages of the repository, as the site has them: `docs/`, and the project's own from its root."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
FROM_ROOT = {
    "CHANGELOG.md": "project/changelog.md",
    "CODE_OF_CONDUCT.md": "project/code-of-conduct.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "SECURITY.md": "project/reporting-security-faults.md",
}
KINDS = {".md", ".ipynb", ".png", ".svg", ".csv", ".toml", ".h"}
UNREAD = {"site", "__pycache__"}  # folders of docs/ that hold no pages
LINK = re.compile(r"\]\(([^)#\s]+)")


def gathered() -> Iterator[tuple[str, bytes]]:
    """Yield each file that the site takes from the repository, by its path in the site."""
    for path in sorted(DOCS.rglob("*")):
        where = path.relative_to(DOCS)
        if path.suffix in KINDS and not UNREAD & set(where.parts):
            yield where.as_posix(), path.read_bytes()
    for name, place in FROM_ROOT.items():
        text = (ROOT / name).read_text(encoding="utf-8")
        yield place, from_root(text).encode()


def from_root(text: str) -> str:
    """Return a page of the repository's root with its links as from `project/` of the site."""
    return LINK.sub(lambda found: f"]({_link(found[1])}", text)


def _link(target: str) -> str:
    if target in FROM_ROOT:
        return "../" + FROM_ROOT[target]
    return "../" + target.removeprefix("docs/") if target.startswith("docs/") else target


def write_changed(folder: Path, files: Mapping[str, bytes]) -> None:
    """Leave exactly these files in a folder; one that is unchanged keeps its time.

    Sphinx reads again what has a new time.
    """
    for path in [path for path in folder.rglob("*") if path.is_file()]:
        if path.relative_to(folder).as_posix() not in files:
            path.unlink()
    for place, content in files.items():
        path = folder / place
        if path.exists() and path.read_bytes() == content:
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
