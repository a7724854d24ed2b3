"""What wheels, gyros, coils and jets say when each is driven a little, after asking.

A fifth of the greatest input for a second and a half, and the same back; of jets a dozen short
pulses to and fro. Whether a device follows is for the bench's interlock to say, as on any run: a
device that does not ends the check with its sentence.
"""

from collections.abc import Callable, Iterator, Sequence

from equipoise.app.bench.check_result import CheckResult
from equipoise.hardware.bench.bench_controller import Keeper
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.hardware.links.actuator_link import ActuatorLink
from equipoise.model.devices import Device, JetPair, greatest_input, least_input

SHARE, DRIVEN = 0.2, 1.5  # of the greatest input; s, each way: longer than a stuck device needs
PULSES, BETWEEN = 12, 0.15  # each way: more than a jet without gas needs; s
SHORT = 0.02  # s, chosen: of a pulse, where the shortest is shorter
AFTER = 0.5  # s, to see it rest


def actuators_answer(links: Sequence[ActuatorLink]) -> Iterator[CheckResult]:
    """Return which actuators answer and agree, and what would better be otherwise."""
    for link in links:
        names = ", ".join(link.unit.drives)
        yield CheckResult(
            True, f"actuator {link.unit.name}: answers, settings agree, {names} at rest"
        )
        for remark in link.driver.remarks:
            yield CheckResult(False, f"actuator {link.unit.name}: {remark.sentence}")


def devices_follow(
    bench: RealBench, keeper: Keeper, agreed: Callable[[str], bool]
) -> Iterator[CheckResult]:
    """Drive each device that an actuator drives; BenchStopped where one does not follow."""
    driven = {name for link in keeper.links.actuators for name in link.unit.drives}
    for device in (each for each in keeper.testbed.devices if each.name in driven):
        if not agreed(f"Drive {device.name} slightly, in both directions?"):
            yield CheckResult(True, f"device {device.name}: not driven")
            continue
        _to_and_fro(bench, device)
        bench.stop()
        bench.read(AFTER)
        yield CheckResult(
            True, f"device {device.name}: follows; check its direction of rotation by eye"
        )


def _to_and_fro(bench: RealBench, device: Device) -> None:
    for sign in (1.0, -1.0):
        if isinstance(device, JetPair):
            pulse = max(least_input(device), device.torque * SHORT)
            for _ in range(PULSES):
                bench.drive({device.name: sign * pulse})
                bench.read(BETWEEN)
        else:
            bench.drive({device.name: sign * SHARE * greatest_input(device)})
            bench.read(DRIVEN)
