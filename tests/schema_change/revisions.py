"""Compare every document of two revisions, to the bit, on the processor that is at hand.

The former revision is checked out into a worktree of its own, which goes again afterwards. Its
kernels are compiled anew: some two minutes on two cores.
"""

import subprocess
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.schema_change.compare import Comparison, Difference
from tests.schema_change.inputs import CASES, Case
from tests.schema_change.run import CONSOLE, documents_of

ROOT = Path(__file__).resolve().parents[2]
EXACT = Comparison()


@contextmanager
def worktree(revision: str, repository: Path = ROOT) -> Generator[Path]:
    """Check a revision out into a temporary worktree."""
    git = ("git", "-C", str(repository), "worktree")
    with TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        subprocess.run([*git, "add", "--quiet", "--detach", str(tree), revision], check=True)
        try:
            yield tree
        finally:
            subprocess.run([*git, "remove", "--force", str(tree)], check=True)


def compare_revisions(
    revision: str, cases: Sequence[Case] = CASES, how: Comparison = EXACT
) -> list[Difference]:
    """Return how documents of this source tree differ from those of a revision.

    The revision is one before the changes that ``renames`` declares.
    """
    CONSOLE.print(f"documents of {revision}", markup=False)
    with worktree(revision) as tree:
        before = dict(documents_of(cases, tree / "src"))
    CONSOLE.print("documents of this source tree")
    after = documents_of(cases, ROOT / "src")
    return [found for name, document in after
            for found in how.differences(name, before[name], document)]  # fmt: skip
