"""What a device says of its outputs, compared with what the testbed says of its devices."""

from collections.abc import Sequence

from equipoise.hardware.actuators.messages import VERSION, Description, Hello
from equipoise.model.devices import REPORTED, TRAITS, Device, greatest_input, least_input

NEAR = 1e-3  # relative, chosen: limits that are printed with four digits
DEADMAN = (0.2, 1.0)  # s, chosen: two beats that are lost end nothing; a second is a long way


def disagreement_at_hello(hello: Hello, devices: Sequence[Device]) -> str:
    """Return what is wrong with who it is; empty if nothing is."""
    if hello.version != VERSION:
        return f"it speaks version {hello.version} of device lines, this program {VERSION}"
    if hello.outputs != len(devices):
        return f"it has {hello.outputs} outputs, the testbed drives {len(devices)} devices by it"
    least, most = DEADMAN
    if not least <= hello.deadman <= most:
        return f"its deadman is {hello.deadman:g} s; wanted {least:g} to {most:g} s"
    return ""


def disagreement(description: Description, device: Device) -> str:
    """Return what is wrong with an output; empty if nothing is."""
    traits, place = TRAITS[type(device)], f"its output {description.index}"
    for what, found, wanted in (
        ("is called", description.name, device.name),
        ("is a", description.kind, REPORTED[type(device)]),
        ("takes", description.units[0], traits.input_unit),
        ("counts", description.units[1], traits.counted_unit),
    ):
        if found != wanted:
            return f"{place} {what} '{found}', in the testbed '{wanted}'"
    return _limits(description, device, traits.input_unit)


def _limits(description: Description, device: Device, unit: str) -> str:
    """Return what it cannot do that the testbed says it can."""
    most, least, limited = greatest_input(device), least_input(device), TRAITS[type(device)].limit
    if limited and description.greatest < most * (1 - NEAR):
        return (
            f"{device.name} takes {description.greatest:g} {unit} at most, by the testbed {most:g}"
        )
    if description.least > least * (1 + NEAR):
        return (
            f"{device.name} takes {description.least:g} {unit} at least, by the testbed {least:g}"
        )
    return ""
