"""URDF, SDF and MJCF: one link, with the tensor about its centre of mass."""

from xml.sax.saxutils import escape, quoteattr

from equipoise.io.exchange.remarks import lines_of
from equipoise.model.arrays import Floats
from equipoise.model.stated_body import StatedBody

HEAD = '<?xml version="1.0"?>'
NAMES = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


def comment(stated: StatedBody) -> str:
    """Return the remarks as a comment; two hyphens would end it."""
    text = "\n".join(f"  {line}" for line in lines_of(stated))
    return f"<!--\n{escape(text).replace('--', '- -')}\n-->"


def numbers(values: Floats) -> str:
    """Return numbers that read back as the same, with blanks between."""
    return " ".join(repr(float(value)) for value in values)


def urdf(stated: StatedBody) -> str:
    """Return a robot of one link."""
    six = zip(NAMES, stated.about_C, strict=True)
    inertia = " ".join(f'{name}="{float(value)!r}"' for name, value in six)
    return "\n".join((
        HEAD, comment(stated), f"<robot name={quoteattr(stated.name)}>", '  <link name="platform">',
        "    <inertial>", f'      <origin xyz="{numbers(stated.body.com)}" rpy="0 0 0"/>',
        f'      <mass value="{stated.body.mass!r}"/>', f"      <inertia {inertia}/>",
        "    </inertial>", "  </link>", "</robot>", "",
    ))  # fmt: skip


def sdf(stated: StatedBody) -> str:
    """Return a model of one link."""
    six = zip(NAMES, stated.about_C, strict=True)
    inertia = [f"          <{name}>{float(value)!r}</{name}>" for name, value in six]
    return "\n".join((
        HEAD, comment(stated), '<sdf version="1.10">', f"  <model name={quoteattr(stated.name)}>",
        '    <link name="platform">', "      <inertial>",
        f"        <pose>{numbers(stated.body.com)} 0 0 0</pose>",
        f"        <mass>{stated.body.mass!r}</mass>", "        <inertia>", *inertia,
        "        </inertia>", "      </inertial>", "    </link>", "  </model>", "</sdf>", "",
    ))  # fmt: skip


def mjcf(stated: StatedBody) -> str:
    """Return a body that turns freely about P; ``fullinertia`` is xx, yy, zz, xy, xz, yz."""
    return "\n".join((
        HEAD, comment(stated), f"<mujoco model={quoteattr(stated.name)}>",
        '  <compiler inertiafromgeom="false"/>', "  <worldbody>", '    <body name="platform">',
        '      <joint name="air_bearing" type="ball"/>',
        f'      <inertial pos="{numbers(stated.body.com)}" mass="{stated.body.mass!r}"',
        f'                fullinertia="{numbers(stated.about_C)}"/>',
        "    </body>", "  </worldbody>", "</mujoco>", "",
    ))  # fmt: skip
