"""All files of a generated program, by name."""

from equipoise.model.bench import Bench
from equipoise.onboard.program.board import board_of
from equipoise.onboard.sources.header import header
from equipoise.onboard.sources.programs import CMAKE, STREAM, replay_program, test_vector
from equipoise.onboard.sources.readme import readme
from equipoise.onboard.sources.source import source
from equipoise.onboard.sources.translated import Translated
from equipoise.onboard.trial import plain_answer, run_trial

DURATION, PERIOD = 32.0, 0.2  # s, chosen: past the first move of ivanov_25s, at a camera's rate


def files_of(found: Translated, bench: Bench) -> dict[str, str]:
    """Return the files of a program; its test vector is a run on a bench, which is used up."""
    board, memory = board_of(found.method, found.law, found.testbed, found.target)
    trial = run_trial(bench, plain_answer(board, memory), DURATION, PERIOD)
    return {
        "equipoise.h": header(found),
        "equipoise.c": source(found),
        "CMakeLists.txt": CMAKE,
        "replay_test_vector.c": replay_program(),
        "stream_rows.c": STREAM,
        "test_vector.h": test_vector(found, list(trial.rows), list(trial.answers[:, :-1])),
        "README.md": readme(found),
    }
