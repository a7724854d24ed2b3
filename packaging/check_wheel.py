"""Try the wheel as its users get it: in a fresh environment, with the source out of the way.

    python packaging/check_wheel.py [WHEEL]

Without WHEEL one is built. The script needs the standard library alone; pip fetches the rest. First
the wheel is installed without extras: each extra's command has to name the line to type. Then it is
installed with them: report as PDF, dashboard (in Chromium, where there is one), and each extra's
command again. A table at the end; exit code 1 if anything failed.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import venv
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "build/check_wheel.png"
LONGEST = 1800.0  # s, chosen: to install all extras, or compile all kernels, on a slow computer
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
INSTALLED_BROWSERS = (
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "C:/Program Files/Google/Chrome/Application/chrome.exe",
)
# What a page, a report and a type checker need of the wheel, beside modules.
CONTENTS = (
    "equipoise/app/dashboard/static/vendor/three.module.js",
    "equipoise/app/dashboard/static/vendor/uPlot.esm.js",
    "equipoise/app/report/page.html",
    "equipoise/app/report/page.typ",
    "equipoise/io/testbed/presets/sputnix.toml",
    "equipoise/py.typed",
)
COMPARE = "compare reference-table --laws --only pid --runs 1"
# A command for each extra; what it reads is written by `write_files` and `simulate`.
NEEDS = {
    "analysis": "to_pandas",
    "camera": "print-board --out board.pdf",
    "cluster": f"{COMPARE} --on dask-local",
    "dashboard": "dashboard nanosat --port 0",
    "excel": "inspect swing.xlsx",
    "hardware": "devices",
    "logs": "convert swing.csv swing.mcap",
    "mavlink": "inspect flight.tlog",
    "matlab": "inspect swing.mat",
    "parquet": "convert swing.csv swing.parquet",
    "report": "report demo --png",
}
NOT_OF_COMMANDS = {"all", "notebook", "peers"}
TO_PANDAS = """
import sys
import equipoise as eq
from equipoise.model.errors import InputError
try:
    eq.read_recording("swing.csv").to_pandas()
except InputError as error:
    print(error, file=sys.stderr)
    sys.exit(2)
"""


class Failed(Exception):
    """A check that did not pass; the text says why."""


class LeftOut(Exception):
    """A check that cannot be carried out here; the text says why."""


@dataclass(frozen=True, slots=True)
class Result:
    """A line of the table at the end."""

    what: str
    passed: bool | None  # None: left out
    remark: str
    seconds: float


@dataclass(frozen=True, slots=True)
class Place:
    """A fresh environment, and a folder to work in that is not the source's."""

    environment: Path
    folder: Path

    def program(self, name: str) -> str:
        """Return the path of a program of the environment."""
        scripts = self.environment / ("Scripts" if os.name == "nt" else "bin")
        return str(scripts / (f"{name}.exe" if os.name == "nt" else name))

    def run(self, *words: str) -> subprocess.CompletedProcess[str]:
        """Run a program of the environment to its end."""
        return subprocess.run(
            (self.program(words[0]), *words[1:]),
            cwd=self.folder, env=clean(), capture_output=True, encoding="utf-8", errors="replace",
            timeout=LONGEST, check=False,
        )  # fmt: skip

    def done(self, *words: str) -> str:
        """Run a program that has to end well, and return what it printed."""
        ended = self.run(*words)
        if ended.returncode != 0:
            raise Failed(f"exit code {ended.returncode}: {last_line(ended.stderr)}")
        return ended.stdout + ended.stderr

    def install(self, *what: str) -> None:
        """Install packages."""
        self.done("python", "-m", "pip", "install", "--quiet", *what)


class Checks:
    """Checks, one behind the other, and what came of them."""

    def __init__(self) -> None:
        self.results: list[Result] = []

    def add(self, what: str, check: Callable[[], str]) -> None:
        """Carry out a check that returns a remark."""
        start = time.monotonic()
        passed: bool | None = True
        try:
            remark = check()
        except LeftOut as error:
            passed, remark = None, str(error)
        except (Failed, subprocess.TimeoutExpired, OSError) as error:
            passed, remark = False, str(error)
        self.results.append(Result(what, passed, remark, time.monotonic() - start))
        print(line_of(self.results[-1]), flush=True)

    @property
    def failed(self) -> int:
        """Return how many failed."""
        return sum(result.passed is False for result in self.results)


def main(given: str | None = None) -> int:
    """Check a wheel; return the exit code."""
    checks = Checks()
    with tempfile.TemporaryDirectory(prefix="wheel-") as work:
        place = Place(Path(work) / "environment", Path(work) / "folder")
        place.folder.mkdir()
        wheel = Path(given).resolve() if given else built(Path(work))
        checks.add("contents", lambda: contents_of(wheel))
        checks.add("installs without extras", lambda: installed(place, wheel))
        if not checks.failed:
            without_extras(checks, place, wheel)
            with_extras(checks, place, wheel)
    print(f"\n{wheel.name}, Python {sys.version.split()[0]}, {sys.platform}")
    print("\n".join(map(line_of, checks.results)))
    passed = sum(result.passed is True for result in checks.results)
    print(f"{passed} passed, {checks.failed} failed")
    return 1 if checks.failed else 0


def without_extras(checks: Checks, place: Place, wheel: Path) -> None:
    """Check the wheel alone: it works, and names the line to type for each extra."""
    checks.add("demo without extras", lambda: demo(place))
    checks.add("simulate", lambda: simulated(place))
    for extra in extras_of(wheel):
        checks.add(f"{extra} missing", lambda extra=extra: missing(place, extra))


def with_extras(checks: Checks, place: Place, wheel: Path) -> None:
    """Check what the lines install: report and dashboard by themselves, then all extras."""
    checks.add("installs report", lambda: place.install(f"{wheel}[report]") or "")
    checks.add("report as PDF", lambda: report(place))
    checks.add("installs dashboard", lambda: place.install(f"{wheel}[dashboard]") or "")
    checks.add("dashboard in Chromium", lambda: page_drawn(place))
    checks.add("installs all", lambda: place.install(f"{wheel}[all,mavlink]") or "")
    for extra in extras_of(wheel):
        if extra != "dashboard":  # which goes on until somebody ends it
            checks.add(f"{extra} installed", lambda extra=extra: there(place, extra))


# --- The wheel ------------------------------------------------------------------------------------


def built(folder: Path) -> Path:
    """Return a wheel built from the source."""
    words = ["-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(folder), str(ROOT)]
    subprocess.run([sys.executable, *words], check=True, timeout=LONGEST)
    (wheel,) = folder.glob("*.whl")
    return wheel


def contents_of(wheel: Path) -> str:
    """Check what is in the wheel."""
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    lacking = [name for name in CONTENTS if name not in names]
    foreign = {name.split("/")[0] for name in names if not name.startswith("equipoise")}
    if lacking or foreign:
        raise Failed(f"lacks {lacking}, and has {sorted(foreign)} beside equipoise")
    return f"{len(names)} files, {wheel.stat().st_size / 1e6:.1f} MB"


def extras_of(wheel: Path) -> list[str]:
    """Return the extras that commands need; each has to have a command in NEEDS."""
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (n for n in archive.namelist() if n.endswith(".dist-info/METADATA"))
        metadata = archive.read(name).decode()
    extras = set(re.findall(r"^Provides-Extra: (\S+)", metadata, re.MULTILINE))
    return sorted(extras - NOT_OF_COMMANDS)


def installed(place: Place, wheel: Path) -> str:
    """Install the wheel alone; what is imported is the wheel's."""
    venv.create(place.environment, with_pip=True)
    place.install(str(wheel))
    at = Path(place.done("python", "-c", "import equipoise; print(equipoise.__file__)").strip())
    if place.environment.resolve() not in at.resolve().parents:
        raise Failed(f"equipoise is imported from {at}")
    return place.done("equipoise", "--version").strip()


# --- Commands -------------------------------------------------------------------------------------


def demo(place: Place) -> str:
    """Run the demo without typst: HTML, and why no PDF."""
    printed = place.done("equipoise", "demo", "--out", "demo")
    if not (place.folder / "demo/report.html").is_file():
        raise Failed("no report.html")
    if 'pip install "equipoise[report]"' not in printed:
        raise Failed("does not say why there is no PDF")
    return "report.html, and why no PDF"


def simulated(place: Place) -> str:
    """Write the files that the extras' commands read."""
    place.done("equipoise", "simulate", "nanosat", "--out", "swing.csv", "--duration-s", "5")
    with zipfile.ZipFile(place.folder / "swing.xlsx", "w") as archive:
        archive.writestr("xl/workbook.xml", "<workbook/>")
    text = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM"
    (place.folder / "swing.mat").write_bytes(text.ljust(512, b"\0") + b"\x89HDF\r\n\x1a\n")
    heartbeat = bytes(8) + bytes.fromhex("fe0900010100000000000203510403")
    (place.folder / "flight.tlog").write_bytes(2 * (heartbeat + bytes(2)))
    return "swing.csv"


def words_of(extra: str) -> tuple[str, ...]:
    """Return the command that needs an extra."""
    if extra not in NEEDS:
        raise Failed("no command of it in NEEDS")
    if NEEDS[extra] == "to_pandas":
        return ("python", "-c", TO_PANDAS)
    return ("equipoise", *NEEDS[extra].split())


def missing(place: Place, extra: str) -> str:
    """Run an extra's command without it."""
    ended = place.run(*words_of(extra))
    line = f'pip install "equipoise[{extra}]"'
    if line not in ended.stderr or "Traceback" in ended.stderr or ended.returncode != 2:
        raise Failed(f"exit code {ended.returncode}: {last_line(ended.stderr)}")
    return line


def there(place: Place, extra: str) -> str:
    """Run an extra's command with it: nothing is missing, whatever else it finds."""
    ended = place.run(*words_of(extra))
    printed = ended.stdout + ended.stderr
    if "pip install" in printed or "Traceback" in printed or ended.returncode not in (0, 1, 2):
        raise Failed(f"exit code {ended.returncode}: {last_line(ended.stderr)}")
    return f"exit code {ended.returncode}"


def report(place: Place) -> str:
    """Set the demo's report anew: now there is a PDF."""
    place.done("equipoise", "report", "demo")
    if not (place.folder / "demo/report.pdf").read_bytes().startswith(b"%PDF"):
        raise Failed("report.pdf is no PDF")
    return "report.pdf"


# --- The dashboard --------------------------------------------------------------------------------


def page_drawn(place: Place) -> str:
    """Look at the page, in a browser driven from an environment of its own."""
    found = (*map(shutil.which, BROWSERS), *filter(os.path.exists, INSTALLED_BROWSERS))
    browser = next(filter(None, found), None)
    with dashboard(place) as url:
        if browser is None:
            raise LeftOut("starts; no Chromium here to look at it")
        driver = Place(place.environment.with_name("browser"), place.folder)
        venv.create(driver.environment, with_pip=True)
        driver.install("playwright")
        PICTURE.parent.mkdir(exist_ok=True)
        script = Path(__file__).with_name("page_in_browser.py")
        return driver.done("python", str(script), browser, url, str(PICTURE)).strip()


@contextmanager
def dashboard(place: Place) -> Iterator[str]:
    """Lend the address of a running dashboard, which ends as by Ctrl-C."""
    log = place.folder / "dashboard.txt"
    words = (place.program("equipoise"), "dashboard", "nanosat", "--port", "0")
    with log.open("w", encoding="utf-8") as file:
        running = subprocess.Popen(
            words, stdout=file, stderr=file, cwd=place.folder, env=clean(PYTHONUNBUFFERED="1")
        )
    try:
        yield address(running, log)
    finally:
        running.send_signal(signal.SIGTERM if os.name == "nt" else signal.SIGINT)
        code = running.wait(60.0)
    if code != 0 and os.name != "nt":
        raise Failed(f"the dashboard ended with exit code {code}: {last_line(log.read_text())}")


def address(running: subprocess.Popen[bytes], log: Path) -> str:
    """Return what the dashboard prints as its address."""
    until = time.monotonic() + LONGEST
    while time.monotonic() < until and running.poll() is None:
        found = re.search(r"dashboard is at (\S+)", log.read_text(encoding="utf-8"))
        if found:
            return found.group(1)
        time.sleep(0.2)
    raise Failed(f"the dashboard does not start: {last_line(log.read_text(encoding='utf-8'))}")


# --- Text -----------------------------------------------------------------------------------------


def clean(**more: str) -> dict[str, str]:
    """Return the environment without what leads Python to the source."""
    ours = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    return ours | {"PYTHONUTF8": "1"} | more


def last_line(text: str) -> str:
    """Return the last line that says something."""
    return next((each for each in reversed(text.splitlines()) if each.strip()), "nothing said")


def line_of(result: Result) -> str:
    """Return a line of the table."""
    mark = {True: "passed", False: "FAILED", None: "left out"}[result.passed]
    return f"{mark:8}  {result.what:24} {result.seconds:6.1f} s  {result.remark}"


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:2]))
