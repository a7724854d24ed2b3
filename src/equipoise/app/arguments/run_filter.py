"""Options that choose runs of a logbook."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args

from cyclopts import Parameter

from equipoise.app.arguments.options import Whole

if TYPE_CHECKING:
    from equipoise.io.documents.logbook import Choice


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class WantedRuns:
    """Which runs.

    Attributes
    ----------
    platform
        Of platforms whose name holds this, small and capital letters alike.
    kind
        balance or identify.
    outcome
        passed, failed, undecided, halted, usable or not_usable.
    method
        Of this method or law.
    since
        Not before this day or time, such as 2026-03-01.
    until
        Before this day or time.
    last
        Of these the last so many; 0: all.
    """

    platform: str | None = None
    kind: str | None = None
    outcome: str | None = None
    method: str | None = None
    since: str | None = None
    until: str | None = None
    last: Whole = 20


LATEST = WantedRuns()
BUILDS = "SELECT id FROM builds WHERE instr(lower(platform), lower(?)) > 0"  # few beside the runs


def choice_of(wanted: WantedRuns) -> "Choice":
    """Return what a logbook is asked for."""
    from equipoise.io.documents.logbook import Choice

    parts = list(_parts(wanted))
    where = " AND ".join(text for text, _ in parts)
    return Choice(where, [value for _, value in parts], wanted.last or None)


def _parts(wanted: WantedRuns) -> Iterator[tuple[str, Any]]:
    from equipoise.app.arguments.checks import one_of
    from equipoise.model.logged_run import Kind, Usability
    from equipoise.model.verdict import VerdictOutcome

    if wanted.platform is not None:
        yield f"build IN ({BUILDS})", wanted.platform
    if wanted.kind is not None:
        yield "kind = ?", one_of("--kind", wanted.kind, list(get_args(Kind)))
    if wanted.outcome is not None:
        yield "outcome = ?", one_of("--outcome", wanted.outcome, [*VerdictOutcome, *Usability])
    if wanted.method is not None:
        yield "method = ?", wanted.method
    for option, text, sign in (("--since", wanted.since, ">="), ("--until", wanted.until, "<")):
        if text is not None:
            yield f"utc {sign} ?", _utc(option, text)


def _utc(option: str, text: str) -> float:
    """Return a day or time, of this computer's clock if it names none, as seconds since 1970."""
    from datetime import datetime

    from equipoise.model.errors import InputError

    try:
        return datetime.fromisoformat(text).timestamp()
    except ValueError as error:
        raise InputError(option, f"'{text}'", "a day or time, such as 2026-03-01") from error
