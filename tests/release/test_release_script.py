"""packaging/release.py: versions, notes and checksums."""

import hashlib
import subprocess
import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest

from equipoise.model.version import __version__

ROOT = Path(__file__).parents[2]
CHANGELOG = (
    "# Changelog\n\n## 0.3.0 (2027-01-02)\n\nNew.\n\n### Fixed\n\n- It.\n\n## 0.2.0\n\nOld.\n"
)


@pytest.fixture
def release():
    spec = spec_from_file_location("release", ROOT / "packaging/release.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_notes_are_the_section_of_the_version(release):
    assert release.section_of(CHANGELOG, "0.3.0") == "New.\n\n### Fixed\n\n- It.\n"
    assert release.section_of(CHANGELOG, "0.2.0") == "Old.\n"
    with pytest.raises(SystemExit, match=r"found no section '## 0\.3\.1'"):
        release.section_of(CHANGELOG, "0.3.1")


def test_every_file_states_the_version_of_the_tag(release):
    for name, pattern in release.VERSIONS.items():
        release.check_version(name, pattern, __version__)
        with pytest.raises(SystemExit, match=rf"found version {__version__}; wanted 9\.9\.9"):
            release.check_version(name, pattern, "9.9.9")


def test_another_tag_builds_nothing():
    words = [sys.executable, "packaging/release.py", "v9.9.9"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "wanted 9.9.9, as the tag has it" in done.stderr


def test_checksums_are_those_of_the_built_files(release, tmp_path, monkeypatch):
    monkeypatch.setattr(release, "DIST", tmp_path)
    for name in ("equipoise-1.tar.gz", "equipoise-1.whl", "notes.md"):
        (tmp_path / name).write_bytes(name.encode())
    digest = hashlib.sha256(b"equipoise-1.whl").hexdigest()
    lines = release.checksums().splitlines()
    assert [line.split("  ")[1] for line in lines] == ["equipoise-1.tar.gz", "equipoise-1.whl"]
    assert lines[1].split("  ")[0] == digest
