"""All files of a generated program, by name."""

from collections.abc import Mapping

from equipoise.model.bench import Bench
from equipoise.onboard.program.board import board_of
from equipoise.onboard.sources.filled import filled, values_of
from equipoise.onboard.sources.translated import Translated
from equipoise.onboard.trial import plain_answer, run_trial

DURATION, PERIOD = 32.0, 0.2  # s, chosen: past the first move of ivanov_25s, at a camera's rate


def files_of(found: Translated, templates: Mapping[str, str], bench: Bench) -> dict[str, str]:
    """Return the files of a program; its test vector is a run on a bench, which is used up."""
    board, memory = board_of(found.method, found.law, found.testbed, found.target)
    trial = run_trial(bench, plain_answer(board, memory), DURATION, PERIOD)
    values = values_of(found, list(trial.rows), list(trial.answers[:, :-1]))
    return {name: filled(text, values) for name, text in templates.items()}
