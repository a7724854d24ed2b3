"""Options that say what a balanced platform is exposed to; what is not stated does not count."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from cyclopts import Parameter

if TYPE_CHECKING:
    from equipoise.planning.sizing.environment import Surroundings


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class Exposure:
    """What happens to the platform between the last measurement and the experiment.

    Attributes
    ----------
    temperature_k
        By how much the temperature changes meanwhile, K.
    expansion_um_m_k
        How much the platform's material grows, um per m and K; 23 is aluminium's.
    length_m
        How far from the bearing the platform's heavy parts are, m; 0.3 is assumed.
    lopsided_percent
        Share by which one side grows more than the other; 10 is assumed.
    bending_hz
        Lowest bending mode of the deck, Hz: it sags by g / (2 pi f)^2.
    bending_share_percent
        Share of the sag that the centre of mass takes part in; all of it is assumed.
    form_error_um
        Form error of the bearing's sphere, um rms.
    air_change_percent
        By how much the density of the air changes meanwhile; 1 % is 3 K or 10 hPa.
    volume_l
        Volume of the platform, l; with the change of the air it gives a torque.
    lever_mm
        How far from the bearing the centre of that volume is, mm; 50 is assumed.
    slew_deg_s
        Rate at which the platform will be turned, deg/s, for the torque of the Earth's rate.
    air_torque
        Torque of moving air and of the bearing, N m rms; assumed as others measured it.
    """

    temperature_k: float = 0.0
    expansion_um_m_k: float = 23.0
    length_m: float = 0.3
    lopsided_percent: float = 10.0
    bending_hz: float = 0.0
    bending_share_percent: float = 100.0
    form_error_um: float = 0.0
    air_change_percent: float = 0.0
    volume_l: float = 0.0
    lever_mm: float = 50.0
    slew_deg_s: float = 0.0
    air_torque: float = 1e-6


CALM = Exposure()


def surroundings_of(exposure: Exposure) -> "Surroundings":
    """Return what is stated, in SI; InputError for what is below zero."""
    from dataclasses import asdict

    from equipoise.app.arguments.checks import not_negative
    from equipoise.model.units import DEG, LITRE, MM, PERCENT, UM, in_si
    from equipoise.planning.sizing.environment import Surroundings

    for name, value in asdict(exposure).items():
        not_negative(f"--{name.replace('_', '-')}", value)
    return Surroundings(
        temperature=exposure.temperature_k,
        expansion=in_si(exposure.expansion_um_m_k, UM),
        length=exposure.length_m,
        lopsided=in_si(exposure.lopsided_percent, PERCENT),
        bending=exposure.bending_hz,
        bending_share=in_si(exposure.bending_share_percent, PERCENT),
        form_error=in_si(exposure.form_error_um, UM),
        air_change=in_si(exposure.air_change_percent, PERCENT),
        volume=in_si(exposure.volume_l, LITRE),
        lever=in_si(exposure.lever_mm, MM),
        slew=in_si(exposure.slew_deg_s, DEG),
        air=exposure.air_torque,
    )
