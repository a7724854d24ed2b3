"""What surrounds the simulated platform: tables of its lamp and its cage below ``[truth]``."""

from collections.abc import Sequence
from typing import Annotated

import numpy as np
from pydantic import Field

from equipoise.io.testbed.devices import Lamp
from equipoise.io.toml.key_types import Direction, Holds, Pair, Positive
from equipoise.io.toml.table_records import RecordTable, check_names, record_of
from equipoise.model import defects
from equipoise.model.errors import InputError, nearest


class TrueCoilPair(RecordTable):
    """What a pair of coils of the cage really gives."""

    KIND = defects.TrueCoilPair

    name: str
    gain: Positive = Field(1.0, description="relative to the driven field")
    axis: Annotated[Direction | None, Holds("axis_N")] = Field(
        None, description="laboratory axes; if omitted: as the pair's own key"
    )
    deviation_percent: float | None = Field(
        None,
        description=(
            "of the field at the magnetometer, relative to that at the coils on the "
            "platform; if omitted: drawn within the pair's nonuniformity"
        ),
    )


class TrueLamp(RecordTable):
    """When the lamp is on, and how it really warms the platform."""

    on_s: list[Pair] = Field(
        min_length=1, description="intervals in which it is on; on at 0: has been on for long"
    )
    warms_K: Positive | None = Field(None, description="final value; if omitted: as in [lamp]")
    time_constant_s: Positive | None = Field(None, description="if omitted: as in [lamp]")

    def record(self, where: str) -> defects.TrueLamp:
        """Return the lamp, whose times must grow."""
        t = np.array(self.on_s).ravel()
        if t[0] < 0 or np.any(np.diff(t) <= 0):
            raise InputError(f"{where}.on_s", f"{self.on_s}", "increasing times from 0 on")
        return record_of(defects.TrueLamp, self, where)


def check_true_rows(rows: Sequence[TrueCoilPair], names: Sequence[str], where: str) -> None:
    """Raise InputError for what is true of no coil pair, or a second table of one."""
    check_names(rows, where)
    for i, row in enumerate(rows, 1):
        if row.name not in names:
            wanted = nearest(row.name, list(names)) if names else "a testbed with [[coil_pair]]"
            raise InputError(f"{where}[{i}].name", f"'{row.name}'", wanted)


def check_true_lamp(
    lamp: TrueLamp | None, thermal: list[float] | None, stated: Lamp | None, where: str
) -> None:
    """Raise InputError for warmth of no lamp, or a lamp of which too little is known."""
    if lamp is None and thermal is not None:
        wanted = "a table [truth.lamp] with on_s, the intervals in which it is on"
        raise InputError(f"{where}.thermal_um_K", "a temperature rise without a lamp", wanted)
    for key in ("warms_K", "time_constant_s") if lamp is not None and stated is None else ():
        if getattr(lamp, key) is None:
            wanted = "the lamp's true effect, or a table [lamp] that states it"
            raise InputError(f"{where}.lamp.{key}", "nothing", wanted)
