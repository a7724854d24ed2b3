"""How an estimate ended, in a sentence for a person. Poor data is an outcome, not an error."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Outcome:
    """Whether the numbers may be used, and why or why not."""

    usable: bool
    sentence: str
