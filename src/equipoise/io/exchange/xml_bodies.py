"""The one body of a URDF, an SDF or an MJCF file: mass, centre of mass, tensor in its axes."""

import re
from collections.abc import Callable
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np

from equipoise.maths.attitude import from_euler321, normalise, to_matrix
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import MassProperties, from_centre
from equipoise.model.stated_body import tensor_of

SIX = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
ACTING = re.compile(r"<!(?:DOCTYPE|ENTITY)", re.IGNORECASE)  # may grow without end, or read files
ONE = "one body with mass and inertia"


def body_of_xml(text: str, source: str) -> MassProperties:
    """Return the body about its frame's origin, products as elements of the tensor.

    InputError for another kind of file, for several bodies with inertia, and for what one lacks.
    """
    if ACTING.search(text):
        raise InputError(source, "a document type or entities", "plain URDF, SDF or MJCF")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise InputError(source, f"broken XML: {error}", "URDF, SDF or MJCF") from error
    if root.tag not in READERS:
        raise InputError(source, f"<{root.tag}>", "<robot> (URDF), <sdf> or <mujoco>")
    found = list(root.iter("inertial"))
    if len(found) != 1:
        raise InputError(source, f"{len(found)} elements <inertial>", ONE)
    return READERS[root.tag](found[0], source)


def _urdf(inertial: Element, source: str) -> MassProperties:
    origin = inertial.find("origin")
    com = _numbers(origin, "xyz", 3, source, (0.0,) * 3)
    turn = _turn(_numbers(origin, "rpy", 3, source, (0.0,) * 3))
    (mass,) = _numbers(inertial.find("mass"), "value", 1, source)
    element = inertial.find("inertia")
    six = [float(_numbers(element, name, 1, source)[0]) for name in SIX]
    return _body(float(mass), com, turn, np.array(six))


def _sdf(inertial: Element, source: str) -> MassProperties:
    pose = _text(inertial, "pose", 6, source, (0.0,) * 6)
    stated = inertial.find("pose")
    if stated is not None and stated.attrib:
        raise InputError(
            source, f"<pose> with {', '.join(stated.attrib)}", "x y z roll pitch yaw, rad"
        )
    (mass,) = _text(inertial, "mass", 1, source)
    element = inertial.find("inertia")
    if element is None:
        raise InputError(source, "no <inertia>", ONE)
    moments = [float(_text(element, name, 1, source)[0]) for name in SIX[:3]]
    products = [float(_text(element, name, 1, source, (0.0,))[0]) for name in SIX[3:]]
    return _body(float(mass), pose[:3], _turn(pose[3:]), np.array(moments + products))


def _mjcf(inertial: Element, source: str) -> MassProperties:
    com = _numbers(inertial, "pos", 3, source)
    turn = to_matrix(normalise(_numbers(inertial, "quat", 4, source, (1.0, 0.0, 0.0, 0.0))))
    (mass,) = _numbers(inertial, "mass", 1, source)
    if "fullinertia" in inertial.attrib:
        six = _numbers(inertial, "fullinertia", 6, source)
    else:
        six = np.append(_numbers(inertial, "diaginertia", 3, source), np.zeros(3))
    return _body(float(mass), com, turn, six)


READERS: dict[str, Callable[[Element, str], MassProperties]] = {
    "robot": _urdf, "sdf": _sdf, "mujoco": _mjcf,
}  # fmt: skip


def _body(mass: float, com: Vector3, turn: Matrix3, six: Floats) -> MassProperties:
    return from_centre(mass, com, turn @ tensor_of(six) @ turn.T)


def _turn(rpy: Floats) -> Matrix3:
    """Return the rotation of roll, pitch, yaw (rad): about fixed axes in this order."""
    return to_matrix(from_euler321(*rpy))


def _numbers(
    element: Element | None,
    key: str,
    count: int,
    source: str,
    default: tuple[float, ...] | None = None,
) -> Floats:
    """Return the numbers of an attribute."""
    return _parsed(None if element is None else element.get(key), key, count, source, default)


def _text(
    element: Element, key: str, count: int, source: str, default: tuple[float, ...] | None = None
) -> Floats:
    """Return the numbers of a child's text."""
    return _parsed(element.findtext(key), key, count, source, default)


def _parsed(
    text: str | None, key: str, count: int, source: str, default: tuple[float, ...] | None
) -> Floats:
    if text is None:
        if default is None:
            raise InputError(source, f"no '{key}' in <inertial>", ONE)
        return np.array(default, dtype=float)
    try:
        found = np.array(text.split(), dtype=float)
    except ValueError:
        found = np.array([])
    if len(found) != count or not np.isfinite(found).all():
        raise InputError(source, f"{key} = '{text}'", f"{count} finite numbers")
    return found
