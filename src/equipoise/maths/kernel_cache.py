"""Throw away compiled kernels when any source with a kernel in it has changed.

The compiler keeps kernels on disk and renews one when *its own* file changes, but kernels are
merged into those that call them from other files: an edited sign could live on in a caller. This
is the one place below ``io`` that looks at files, and it looks at the package's own only.
"""

from contextlib import suppress
from hashlib import sha256
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent
MARK = b"maths.compiled import"  # a kernel and all it takes constants from have it
STAMP = PACKAGE / "maths" / "__pycache__" / "kernels.stamp"


def fingerprint(package: Path = PACKAGE) -> str:
    """Return a hash of names, sizes and times of change of the sources that compile something."""
    digest = sha256()
    for source in sorted(package.rglob("*.py")):
        if MARK not in source.read_bytes():
            continue
        observed = source.stat()
        digest.update(
            f"{source.relative_to(package)} {observed.st_size} {observed.st_mtime_ns}".encode()
        )
    return digest.hexdigest()


def drop_stale(package: Path = PACKAGE, stamp: Path = STAMP) -> bool:
    """Remove cached kernels unless they belong to these sources; say whether any rule applied."""
    now = fingerprint(package)
    with suppress(OSError):
        if stamp.read_text() == now:
            return False
    with suppress(OSError):  # a read-only installation never changes
        for cached in [*package.rglob("*.nbi"), *package.rglob("*.nbc")]:
            cached.unlink(missing_ok=True)
        stamp.parent.mkdir(exist_ok=True)
        stamp.write_text(now)
    return True
