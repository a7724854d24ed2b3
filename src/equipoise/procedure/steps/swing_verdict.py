"""The verdict on a fresh swing alone, in which air pushes the platform as it is stated to.

No drift is considered: a platform that turns from level at an even rate shows a drift as it shows a
height. Air leaves of the height, after a time t at tilts that grow evenly to theta, an sd of about

    sqrt(6 T / t) s / (m g theta),      s, T of ``procedure.steps.process_noise``

which is 0.15 um for 4e-7 N m on 4 kg at 8 deg after 40 s.
"""

from equipoise.model.bench import Bench
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.step import Step
from equipoise.model.verdict import Verdict
from equipoise.procedure.steps.joint_fit import learn_alone
from equipoise.procedure.steps.plain_steps import verdict_step
from equipoise.procedure.steps.sampler import Eyes
from equipoise.procedure.steps.tilt_guard import tilted
from equipoise.procedure.steps.verification_swing import watched_swing
from equipoise.procedure.steps.verify import Aim, verdict


def swing_verdict(bench: Bench, eyes: Eyes, aim: Aim, duration: float) -> Step:
    """Return the verdict on a swing of ``duration`` (s), masses and devices at rest."""
    began = bench.time
    fresh = watched_swing(bench, eyes, duration)
    if tilted(fresh, bench.testbed):
        bench.stop()
        return stop_step(bench)
    known = learn_alone(fresh, bench.testbed.without("drift"), aim.budget)
    found = verdict(known, None, began, aim)
    return verdict_step(bench.time, found, found.reasons, known.recording, known.estimate)


def stop_step(bench: Bench) -> Step:
    """Return the stop of a run whose platform tilts too much."""
    verdict = Verdict(one_reason(VerdictReason.TILTED))
    return Step("stop", bench.time, verdict.reasons, verdict=verdict)
