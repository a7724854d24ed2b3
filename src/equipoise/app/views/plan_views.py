"""A plan for terminal, JSON and report.

It shows what the plan promises beside the usual manoeuvre, and what to do.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.runs.planning import Planning, Request
from equipoise.app.text.blocks import (
    Blocks,
    Claim,
    Column,
    Heading,
    Pairs,
    Paragraph,
    Row,
    Section,
    Table,
    number,
    table,
)
from equipoise.app.text.json_results import PLAN
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import unit_for, with_sd
from equipoise.app.text.run_blocks import reason_items
from equipoise.model.arrays import Vector3
from equipoise.model.devices import ReactionWheel
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Manoeuvre, SquareWave
from equipoise.model.testbed import Testbed
from equipoise.model.units import DEG, MM, MN_M
from equipoise.planning.manoeuvre.criterion import OF_COM, OF_MOMENT, size_of
from equipoise.planning.manoeuvre.predicted_sd import Promise, times_better

UPRIGHT = 0.999  # cosine, chosen: a body's z that counts as upright


def output_of(done: Planning) -> Output:
    """Return all that is handed over."""
    return Output("plan", document(done), blocks(done), lambda: record_of(done))


def blocks(done: Planning) -> Blocks:
    """Return what is promised, what to do, how far it goes, and what it gains."""
    return (promise_table(done), *what_to_do(done), *limits_of(done), verdict_claim(done))


def what_to_do(done: Planning) -> Blocks:
    """Return the manoeuvre, step by step."""
    steps = Pairs(tuple(steps_of(done.planned.manoeuvre, done.request.testbed)))
    return Heading("What to do"), steps


def limits_of(done: Planning) -> Blocks:
    """Return what stays unobservable on the expected platform, and how far both manoeuvres go."""
    return (
        *reason_items(done.planned.expected.unobservable),
        Paragraph(limits_line(done.usual, done.request, "The usual manoeuvre"), "quiet"),
        Paragraph(limits_line(done.planned, done.request, "The plan")),
    )


def verdict_claim(done: Planning) -> Claim:
    """Return what the plan gains."""
    return Claim(verdict(done), "good" if done.planned.keeps else "caution")


def record_of(done: Planning) -> RunRecord:
    """Return the plan as a report."""
    request = done.request
    return RunRecord(
        title="The most informative manoeuvre",
        requested={
            "wanted": ", ".join(request.names),
            "criterion": request.criterion,
            "length of the record": f"{request.duration:g} s",
            "greatest rate": f"{request.rate / DEG:g} deg/s",
            "earlier recording": "none" if request.earlier is None else request.earlier.source,
        },
        testbed=request.testbed,
        conclusion=(verdict_claim(done),),
        sections=(
            Section("Predicted accuracy", (promise_table(done),)),
            Section("The manoeuvre", (*what_to_do(done), *limits_of(done))),
        ),
        origin=origin(seed=str(request.seed)),
    )


def promise_table(done: Planning) -> Table:
    """Return predicted sd of the usual manoeuvre and of the plan, and their ratio."""
    columns = (Column(), *map(number, ("usual", "planned", "times better")), Column("unit"))
    after = ", given the earlier recording" if done.request.earlier else ""
    title = f"Predicted sd over {done.planned.platforms} platforms drawn from the prior{after}"
    return table(title, columns, (promise_row(done, name) for name in (*COM, *INERTIA)))


def promise_row(done: Planning, name: str) -> Row:
    """Return one parameter; quiet where it is not wanted."""
    unit = unit_for(name, "m" if name in COM else "kg m2")
    sds = (float(p.sd_of((name,))[0]) / unit.size for p in (done.usual, done.planned))
    texts = [with_sd(0.0, sd)[1] for sd in sds]
    ratio = float(times_better(done.usual, done.planned, (name,))[0])
    shown = f"{ratio:.2g}" if math.isfinite(ratio) and "held" not in texts else ""
    return Row((name, *texts, shown, unit.name), "plain" if name in done.request.names else "quiet")


def steps_of(manoeuvre: Manoeuvre, testbed: Testbed) -> Iterator[tuple[str, str]]:
    """Return when and what, in words for a person at the bench."""
    if manoeuvre.standing:
        yield "before", f"masses start where they were left: {displacements(manoeuvre.standing)}"
    yield "start", lean_words(manoeuvre, testbed.up)
    yield "", rate_words(manoeuvre.rate, testbed.up)
    for wave in manoeuvre.waves:
        yield "from 0 s", wave_words(wave, testbed)
    stands = dict(manoeuvre.standing)
    for t, targets in manoeuvre.moves:
        changed = {name: d for name, d in targets.items() if d != stands.get(name, 0.0)}
        stands.update(changed)
        if changed:
            yield f"{t:g} s", f"send masses to {displacements(changed)}"
    yield f"{manoeuvre.duration:g} s", "end of the record"


def displacements(targets: Mapping[str, float]) -> str:
    """Return displacements from home."""
    return ", ".join(f"{name} {d / MM:+.4g} mm" for name, d in targets.items())


def lean_words(manoeuvre: Manoeuvre, up: Vector3) -> str:
    """Return how to hold the platform."""
    if manoeuvre.tilt == 0:
        return "hold the platform level"
    side = manoeuvre.low_side
    where = "(" + ", ".join(f"{x:.2f}" for x in side + 0.0) + ") of the body axes"
    if up[2] > UPRIGHT:
        angle = math.degrees(math.atan2(side[1], side[0]))
        where = f"{angle:.0f} deg from body x towards y"
    slack = f"to about {manoeuvre.tilt_sd / DEG:g} deg"
    return f"tilt it by {manoeuvre.tilt / DEG:.3g} deg, {slack}, the side at {where} lowest"


def rate_words(rate: Vector3, up: Vector3) -> str:
    """Return how to let go."""
    if not np.any(rate):
        return "release at rest"
    x, y, z = (f"{v / DEG:+.3g}" for v in rate + 0.0)
    spin = float(rate @ up) / DEG
    return f"release with a rate of ({x}, {y}, {z}) deg/s in body axes, {spin:.3g} of it spin"


def wave_words(wave: SquareWave, testbed: Testbed) -> str:
    """Return what a device is driven by."""
    wheel = any(w.name == wave.device for w in testbed.wheels)
    size = (f"{wave.amplitude / MN_M:+.3g} mN m" if wheel
            else f"{wave.amplitude / DEG:+.3g} deg/s")  # fmt: skip
    turns = f"every {wave.period / 2:g} s, first at {wave.period * (0.5 - wave.phase):g} s"
    return f"drive {wave.device} by {size}, and reverse it {turns}"


def limits_line(promise: Promise, request: Request, who: str) -> str:
    """Say how far a manoeuvre goes."""
    testbed, expected, n = request.testbed, promise.expected, promise.tried
    text = (
        f"{who} tilts the expected platform by at most {expected.peak_tilt / DEG:.3g} "
        f"deg, {n} others by up to {promise.greatest_tilt / DEG:.3g} deg, and reaches "
        f"{promise.greatest_rate / DEG:.3g} deg/s; {promise.kept} of them keep the "
        f"limits of {testbed.tilt_limit / DEG:.3g} deg and {request.rate / DEG:g} "
        "deg/s"
    )
    if any(isinstance(d, ReactionWheel) for d in testbed.devices) or testbed.cmgs:
        text += f", stored momentum {expected.peak_momentum:.2g} N m s"
    return text + "."


def worst_of(promise: Promise, done: Planning) -> tuple[str, float]:
    """Return what is known worst of what is asked for, in units of its size."""
    names = done.request.names
    scaled = promise.sd_of(names) / size_of(promise.body, names)
    k = int(np.argmax(scaled))
    return names[k], float(scaled[k])


def verdict(done: Planning) -> str:
    """Say what the plan gains, and whether its limits are kept."""
    (name, before), (other, after) = (worst_of(p, done) for p in (done.usual, done.planned))
    if math.isinf(after):
        text = f"This plan does not determine everything either: {other}."
    elif math.isinf(before):
        text = (
            f"The usual manoeuvre does not determine {name}; the plan determines "
            "everything requested."
        )
    elif before < after:
        text = "The usual manoeuvre would be more informative, but it exceeds the limits."
    else:
        gain = f"by a factor of {before / after:.2g}"
        which = name if other == name else f"{name}, then {other}"
        text = f"The worst-determined quantity ({which}) improves {gain}."
    if done.planned.keeps:
        return text
    advice = (
        "a shorter record or more --trials may keep it"
        if done.request.earlier
        else (
            "the centre of mass is too uncertain: record a short swing, stopped before "
            "the limit, and plan again with --prior-record"
        )
    )
    kept = f"{done.planned.kept} of {done.planned.tried}"
    return f"{text} Only {kept} platforms keep the limits; {advice}."


def document(done: Planning) -> View:
    """Return a plan as JSON, SI units."""
    return PLAN.write({
        "done": done,
        "sizes": {"com_m": OF_COM, "inertia_relative": OF_MOMENT},
    })  # fmt: skip
