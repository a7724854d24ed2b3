"""Whether an estimate tells its reader not to rely on its intervals."""

from equipoise.model.estimate import Estimate

WARNINGS = ("not trustworthy", "do not trust")  # what outcomes say


def warns(estimate: Estimate) -> bool:
    """Say whether an outcome warns: not usable, or usable with intervals that are not."""
    text = estimate.outcome.sentence
    return not estimate.outcome.usable or any(word in text for word in WARNINGS)
