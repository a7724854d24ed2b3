"""Plan first: a planned manoeuvre, and then balancing on all that was recorded."""

from collections.abc import Generator

from equipoise.model.bench import Bench
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.step import Step
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from equipoise.procedure.steps.joint_fit import Knowledge
from equipoise.simulation.carried_out import carried_out


def planned_and_balanced(
    bench: Bench, options: BalanceOptions, manoeuvre: Manoeuvre
) -> Generator[Step, None, Knowledge]:
    """Yield the manoeuvre of a bench that was let go as planned, then the steps of ``balance``.

    Its time and its moves do not count among those that balancing may take. Devices rest then.
    """
    recording = carried_out(bench, manoeuvre)
    if manoeuvre.waves:
        bench.stop()
    text = f"Carried out the planned manoeuvre of {manoeuvre.duration:g} s."
    yield Step("measurement", bench.time, text, recording=recording)
    return (yield from balance(bench, options, recording))
