"""What a browser should keep to: the headers of each answer.

The page runs no script but those of its own address that bear the number of this very answer (a
nonce): no inline script, no ``eval``, and no other address, whatever a text on it holds. What it
imports inherits the number. Files of runs may come from others: they are shown without scripts, in
an origin of their own (``sandbox``).
"""

from collections.abc import Iterator, Mapping

SHUT = "frame-ancestors 'none'; form-action 'none'; base-uri 'none'"
NOTHING = f"default-src 'none'; {SHUT}"
# A report has its pictures and its style within itself.
FILE = f"sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data: 'self'; {SHUT}"
# A browser's own viewer of PDF does not work in a sandbox; a PDF has no scripts of the page.
PDF = f"default-src 'none'; style-src 'unsafe-inline'; object-src 'self'; {SHUT}"
ALWAYS: Mapping[str, str] = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-resource-policy": "same-origin",
    "cross-origin-opener-policy": "same-origin",
}


def of_page(nonce: str, host: str) -> str:
    """Return the policy of the page at a host that is one of ours."""
    return (
        f"default-src 'none'; script-src 'nonce-{nonce}'; style-src-elem 'self' 'nonce-{nonce}'; "
        f"style-src-attr 'none'; img-src 'self' data: blob:; font-src 'self'; "
        f"connect-src 'self' ws://{host}; {SHUT}"
    )


def of_file(name: str) -> str:
    """Return the policy of a file of a run."""
    return PDF if name.lower().endswith(".pdf") else FILE


def added(given: Iterator[str] | set[str], policy: str) -> Iterator[tuple[str, str]]:
    """Yield the headers that an answer lacks."""
    have = {name.lower() for name in given}
    for name, value in {"content-security-policy": policy, **ALWAYS}.items():
        if name not in have:
            yield name, value
