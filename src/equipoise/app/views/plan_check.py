"""Whether a record reached the sd that its plan predicted."""

from collections.abc import Iterator

from equipoise.app.text.blocks import Blocks, Column, Table, number, paragraphs, table
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import unit_for, with_sd
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.manoeuvre import Plan

TWICE = 2.0  # found / predicted, chosen: platforms of one testbed differ by so much
NO_PROMISE = "The plan contains no predictions to compare with."


def promised(plan: Plan) -> dict[str, float]:
    """Return the sd that a plan predicts, by name, SI."""
    if plan.com_sd is None or plan.inertia_sd is None:
        return {}
    return dict(zip((*COM, *INERTIA), map(float, (*plan.com_sd, *plan.inertia_sd)), strict=True))


def pairs(plan: Plan, estimate: Estimate) -> Iterator[tuple[str, float, float]]:
    """Return name, sd predicted and sd found, SI."""
    for name, sd in promised(plan).items():
        if estimate.has(name):
            yield name, sd, estimate.parameters[estimate.index(name)].sd


def plan_blocks(plan: Plan | None, estimate: Estimate) -> Blocks:
    """Return what was planned beside what came of it; nothing where there was no plan."""
    if plan is None:
        return ()
    shown = () if plan.com_sd is None else (kept_table(plan, estimate),)
    return (*shown, *paragraphs(*promise_sentences(plan, estimate)))


def kept_table(plan: Plan, estimate: Estimate) -> Table:
    """Return predicted and found sd side by side."""
    columns = (Column(), number("predicted sd"), number("achieved sd"),
               number("achieved / predicted"), Column("unit"))  # fmt: skip
    rows: list[tuple[str, ...]] = []
    for name, sd, found in pairs(plan, estimate):
        unit = unit_for(name, "m" if name in COM else "kg m2")
        texts = [with_sd(0.0, value / unit.size)[1] for value in (sd, found)]
        rows.append((name, *texts, f"{found / sd:.2f}", unit.name))
    return table("Planned and achieved sd", columns, rows)


def promise_sentences(plan: Plan, estimate: Estimate) -> list[str]:
    """Say whether the plan was kept."""
    ratios = {name: found / sd for name, sd, found in pairs(plan, estimate)}
    if not ratios:
        return [NO_PROMISE]
    low, high = min(ratios.values()), max(ratios.values())
    worst = max(ratios, key=lambda name: ratios[name])
    if high > TWICE:
        return [
            (
                f"The sd of {worst} is {high:.2g} times the planned one: another platform, "
                "another release, or an effect that the plan did not model."
            )
        ]
    return [f"Achieved sd are {low:.2g} to {high:.2g} times the planned ones."]


def kept_json(plan: Plan, estimate: Estimate) -> View:
    """Return what was predicted and found, SI."""
    rows = [{"name": n, "predicted_sd": sd, "found_sd": found}
            for n, sd, found in pairs(plan, estimate)]  # fmt: skip
    return {"source": plan.source, "parameters": rows}
