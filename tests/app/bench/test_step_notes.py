"""What a procedure finds stands in the record of a real bench, and in the scene beside it."""

import numpy as np

from equipoise.app.bench.step_notes import noting
from equipoise.io.files.file_content import Content
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.mcap.mcap_salvage import salvaged
from equipoise.io.testbed.presets import read_preset
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.step import Step
from equipoise.model.verdict import Verdict
from equipoise.simulation.bench import SimulatedBench
from tests.app.bench.test_lost_controller import running
from tests.support.emulated_lab import lab, over_tcp
from tests.support.recorded_events import events_of

COM, SD = np.array([1e-6, -2e-6, 3e-6]), np.array([1e-7, 2e-7, np.inf])
VERDICT = Verdict(one_reason(VerdictReason.TILTED), COM, SD)
STEP = Step("verify", 1.0, VERDICT.reasons, verdict=VERDICT)


def test_a_step_is_noted_with_the_centre_of_mass_that_it_states(tmp_path):
    """An sd that is not known is null: JSON has no infinity."""
    path, shown = tmp_path / "run.mcap", []
    bed = over_tcp(read_preset("nanosat"))
    with LiveRecording(path, Opening(10**18, "", bed)) as record, lab(bed) as found:
        found.keeper.listen(record)
        found.wait(0.2)
        noting(found.bench, shown.append)(STEP)
    assert shown == [STEP]
    (event,) = (each for each in events_of(path) if each.kind == "step")
    assert event.sentence == STEP.sentence
    assert event.data == {"com_m": [1e-6, -2e-6, 3e-6], "sd_m": [1e-7, 2e-7, None]}
    file = salvaged(Content.of(path.read_bytes(), "log"), "run")
    (scene,) = (c.id for c in file.channels.values() if c.topic == "/scene")
    assert sum(m.channel_id == scene for m in file.messages) >= 2  # at first, and after the step


def test_a_simulated_bench_has_nothing_to_note():
    assert noting(SimulatedBench(read_preset("nanosat"), 1), None) is None


def test_a_note_reaches_the_keepers_process():
    """It answers, and does so to the note; a keeper that has ended is not the step's matter."""
    with running() as bench:
        noting(bench, None)(STEP)
        assert [each.device for each in bench.health()] == ["board masses", "sensor imu"]
    noting(bench, None)(STEP)
