"""YAML, CSV, ROS and MATLAB: the numbers with their covariance about both points."""

import csv
import io as streams
import json
import math
from typing import Any, cast

import numpy as np

from equipoise.io.exchange.remarks import TENSOR, central_names, lines_of
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import COM
from equipoise.model.stated_body import StatedBody, order

FORMAT = "equipoise/mass_properties/1"
UNITS = ("kg", *("kg m2",) * 6, *("m",) * 3)


def names_about_C() -> tuple[str, ...]:
    """Return the names of the covariance's rows with the inertia about C."""
    return ("mass", *central_names(), *COM)


def yaml(stated: StatedBody) -> str:
    """Return a YAML document; ``.inf`` is the variance of what the data do not show."""
    body = stated.body
    return "\n".join((
        *(f"# {line}" for line in lines_of(stated)),
        f"format: {FORMAT}", f"name: {json.dumps(stated.name)}", f"mass_kg: {body.mass!r}",
        f"com_P_m: {flow(body.com)}",
        *block("inertia_P_kg_m2", body.inertia_P), *block("inertia_C_kg_m2", body.inertia_C),
        f"covariance_order: [{', '.join(order())}]", *block("covariance", stated.covariance),
        f"covariance_about_C_order: [{', '.join(names_about_C())}]",
        *block("covariance_about_C", stated.covariance_about_C), "",
    ))  # fmt: skip


def flow(values: Floats) -> str:
    """Return a list on one line; YAML wants a point before an exponent."""
    return f"[{', '.join(map(scalar, values))}]"


def scalar(value: float) -> str:
    """Return a number as every reader of YAML takes it: 1e-05 is a text to some."""
    if math.isinf(value):
        return ".inf"
    text = repr(float(value))
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def block(key: str, matrix: Square) -> list[str]:
    """Return a matrix, a line for each row."""
    return [f"{key}:", *(f"- {flow(row)}" for row in matrix)]


def ros(stated: StatedBody) -> str:
    """Return a message geometry_msgs/Inertia: com from P, the tensor about the centre of mass."""
    six = zip(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), stated.about_C, strict=True)
    x, y, z = map(scalar, stated.body.com)
    return "\n".join((
        *(f"# {line}" for line in lines_of(stated)),
        f"m: {scalar(stated.body.mass)}", f"com: {{x: {x}, y: {y}, z: {z}}}",
        *(f"{name}: {scalar(value)}" for name, value in six), "",
    ))  # fmt: skip


def csv_table(stated: StatedBody) -> str:
    """Return a row for each number: value, unit, sd, and its row of the covariance about P."""
    body = stated.body
    values = (body.mass, *stated.about_P, *body.com)
    stream = streams.StringIO()
    table = csv.writer(stream, lineterminator="\n")
    table.writerow(("name", "value", "unit", "sd", *(f"covariance_{name}" for name in order())))
    rows = zip(order(), values, UNITS, stated.covariance, strict=True)
    for k, (name, value, unit, row) in enumerate(rows):
        table.writerow((name, repr(float(value)), unit, sd_of(row[k]), *map(repr, row.tolist())))
    spread = np.diag(stated.covariance_about_C)[1:7]
    for name, value, variance in zip(central_names(), stated.about_C, spread, strict=True):
        table.writerow((name, repr(float(value)), "kg m2", sd_of(variance)))
    return stream.getvalue()


def sd_of(variance: float) -> str:
    """Return the sd of a variance; inf where the data do not show it."""
    return repr(math.sqrt(variance))


def matlab(stated: StatedBody) -> bytes:
    """Return a MAT-file (version 5) with a struct ``platform``."""
    from scipy.io import savemat

    body = stated.body
    platform: dict[str, Any] = {
        "name": stated.name, "mass_kg": body.mass, "com_P_m": body.com,
        "inertia_P_kg_m2": body.inertia_P, "inertia_C_kg_m2": body.inertia_C,
        "covariance": stated.covariance, "covariance_order": list(order()),
        "covariance_about_C": stated.covariance_about_C,
        "covariance_about_C_order": list(names_about_C()),
        "sign_of_products": TENSOR, "remarks": list(stated.remarks),
    }  # fmt: skip
    stream = streams.BytesIO()
    savemat(cast(Any, stream), {"platform": platform}, oned_as="row")
    return stream.getvalue()
