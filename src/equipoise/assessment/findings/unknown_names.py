"""What a recording names and its testbed does not have."""

from equipoise.model.errors import nearest
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason


def unknown_name_findings(
    kind: str, names: tuple[str, ...], known: tuple[str, ...] | None
) -> list[Finding]:
    """Return a problem for each mass or device that is not known; None: nothing is."""
    if known is None:
        return []
    return [
        Finding("problem", one_reason(Why.NOT_IN_TESTBED, kind, name, _meant(name, known)))
        for name in names
        if name not in known
    ]


def _meant(name: str, known: tuple[str, ...]) -> str:
    return nearest(name, list(known)) if known else "it has none"
