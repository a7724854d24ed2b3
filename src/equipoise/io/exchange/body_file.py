"""The body that another tool's file describes: URDF, SDF, MJCF, or a CAD program's text."""

from pathlib import Path

from equipoise.io.exchange.mass_text import WANTED, Notation, parse_mass_text
from equipoise.io.exchange.product_sign import body_of
from equipoise.io.exchange.xml_bodies import body_of_xml
from equipoise.io.files.source_file import read_text
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import MassProperties, is_possible


def read_foreign_body(
    path: str | Path, notation: Notation | None = None
) -> tuple[MassProperties, str]:
    """Return a file's body about the origin of its axes, and what shows the sign of its products.

    ``notation`` says it of a CAD program's text in which nothing shows it. InputError for what
    cannot be read, and for a physically inconsistent inertia.
    """
    text, source = read_text(path, WANTED), str(path)
    if not text.lstrip().startswith("<"):
        return body_of(parse_mass_text(text, source), source, notation)
    body = body_of_xml(text, source)
    if not is_possible(body):
        raise InputError(
            source, "a physically inconsistent inertia", "a file that a simulator takes"
        )
    return body, "products: tensor, as such files have them"
