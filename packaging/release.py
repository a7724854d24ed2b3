"""Make what a release consists of: source archive, wheel, checksums, notes.

    python packaging/release.py v0.2.0

The tag has to be the version in ``model/version.py``, ``pyproject.toml``, ``CITATION.cff`` and the
conda recipe, and the changelog has to have a section of it. The wheel is built from the source
archive, so that the archive is known to hold all that it takes. All goes to ``dist``.
"""

import hashlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DIST = ROOT / "dist"
VERSIONS = {
    "src/equipoise/model/version.py": r'__version__ = "([^"]+)"',
    "pyproject.toml": r'^version = "([^"]+)"',
    "CITATION.cff": r"^version: (\S+)",
    "packaging/conda/recipe.yaml": r'^  version: "([^"]+)"',
}


def main(tag: str) -> None:
    """Check the version, build, and write checksums and notes."""
    version = tag.removeprefix("v")
    for name, pattern in VERSIONS.items():
        check_version(name, pattern, version)
    notes = section_of((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), version)
    shutil.rmtree(DIST, ignore_errors=True)
    DIST.mkdir()
    build(ROOT, "sdist")
    (archive,) = DIST.glob("*.tar.gz")
    build(archive, "wheel")
    (DIST / "notes.md").write_text(notes, encoding="utf-8")
    (DIST / "SHA256SUMS").write_text(checksums(), encoding="utf-8")


def check_version(name: str, pattern: str, version: str) -> None:
    """Stop unless a file states this version."""
    found = re.search(pattern, (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE)
    stated = found.group(1) if found else "none"
    if stated != version:
        sys.exit(f"{name}: found version {stated}; wanted {version}, as the tag has it")


def section_of(changelog: str, version: str) -> str:
    """Return what the changelog says of a version, without its heading."""
    found = re.search(
        rf"^## {re.escape(version)}\b[^\n]*\n(.*?)(?=^## |\Z)", changelog, re.M | re.S
    )
    if found is None:
        sys.exit(f"CHANGELOG.md: found no section '## {version}'; wanted one")
    return found.group(1).strip() + "\n"


def build(source: Path, target: str) -> None:
    """Build a source archive or a wheel into dist."""
    if target == "sdist":
        words = ["-m", "hatchling", "build", "--target", "sdist", "--directory", str(DIST)]
    else:
        words = [
            "-m",
            "pip",
            "wheel",
            "--quiet",
            "--no-deps",
            "--wheel-dir",
            str(DIST),
            str(source),
        ]
    subprocess.run([sys.executable, *words], cwd=ROOT, check=True)


def checksums() -> str:
    """Return a line for each built file, as `sha256sum --check` reads it."""
    files = sorted((*DIST.glob("*.tar.gz"), *DIST.glob("*.whl")))
    return "".join(f"{hashlib.sha256(f.read_bytes()).hexdigest()}  {f.name}\n" for f in files)


if __name__ == "__main__":
    main(*sys.argv[1:2])
