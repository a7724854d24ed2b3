"""The cards of the linear methods: what all of them need, and what none of them can see."""

from equipoise.model.method_card import Card

SENSORS = "a camera or a gyro; tilt is more accurate with a camera"


def balance(name: str, formulation: str, solver: str, source: str, also: str = "") -> Card:
    """Return the card of a method on the whole balance; ``also``: what it needs beside sensors."""
    hidden = (
        "scale of J and com without a known change; J_zz and products without "
        "rotation about more than one axis"
    )
    needs = SENSORS + also
    return Card(name, formulation, solver, source, needs, hidden, "driven", ("term", "hold"))


def simplified_model(name: str, formulation: str, solver: str, source: str) -> Card:
    """Return the card of a method on Euler's simplified model."""
    needs = SENSORS + "; inertia from the testbed (its sd is included)"
    hidden = "J; com along gravity without tilt; com better than J is known"
    return Card(name, formulation, solver, source, needs, hidden, "free", ("term", "hold"))
