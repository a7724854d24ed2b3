"""What Grbl and its kin say to the driver's bytes, dialect by dialect: greeting, report, settings.

It moves at once and keeps no time: what a board does in time is in the emulated firmware.
"""

import re
from dataclasses import dataclass

SETTINGS = "".join(
    f"${base + k}={value}\r\n"
    for base, value in ((100, "800.000"), (110, "480.000"), (120, "200.000"), (130, "200.000"))
    for k in range(3)
)
GRBL = "".join(
    f"${number}={value}\r\n"
    for number, value in (
        (0, "10"), (1, "25"), (10, "1"), (13, "0"), (20, "1"), (22, "1"),
        (24, "100.000"), (25, "480.000"), (26, "250"), (27, "1.000"),
    )
)  # fmt: skip


@dataclass
class Dialect:
    """One firmware; ``report`` is formatted with the state and the position (mm)."""

    greeting: str
    report: str
    settings: str = GRBL + SETTINGS
    locked: bool = True  # until it has homed
    reports_homing: bool = False
    chatter: str = ""  # before the greeting
    lock: str = "[MSG:'$H'|'$X' to unlock]"  # after it, until it has homed

    def __post_init__(self):
        self.at, self.state, self.sent = (0.0, 0.0, 0.0), "Idle", b""

    def answers(self, data):
        """Return what it says to bytes."""
        self.sent += data
        said = ""
        for byte in re.findall(rb"[\x18!~\x85?]|[^\x18!~\x85?\n]*\n", data):
            said += self._answer(byte)
        return said.encode("latin-1")

    def _answer(self, byte):
        if byte == b"\x18":
            self.state = "Alarm" if self.locked else "Idle"
            lock = f"{self.lock}\r\n" if self.locked else ""
            return f"{self.chatter}\r\n{self.greeting}\r\n{lock}"
        if byte == b"?":
            return self.report.format(self.state, ",".join(f"{v:.3f}" for v in self.at)) + "\r\n"
        if byte == b"$$\n":
            return self.settings + "ok\r\n"
        if byte == b"$H\n":
            home = self.report.format("Home", "-0.500,-0.500,-0.500") + "\r\n"
            self.state, self.at, self.locked = "Idle", (-1.0, -1.0, -1.0), False
            return home * self.reports_homing + "ok\r\n"
        if byte.startswith(b"$J="):
            for k, letter in enumerate(b"XYZ"):
                found = re.search(rb"%c(-?[.\d]+)" % letter, byte)
                if found:
                    self.at = (*self.at[:k], float(found[1]), *self.at[k + 1 :])
            return "ok\r\n"
        return "ok\r\n" if byte.endswith(b"\n") else ""


DIALECTS = {
    "Grbl 1.1f": Dialect("Grbl 1.1f ['$' for help]", "<{}|MPos:{}|FS:0,0>"),
    "Grbl 1.1g": Dialect("Grbl 1.1g ['$' for help]", "<{}|MPos:{}|Bf:15,128|FS:0,0|Pn:Z>"),
    "Grbl 1.1h": Dialect("Grbl 1.1h ['$' for help]", "<{}|MPos:{}|FS:0,0|Ov:100,100,100>"),
    "Grbl 1.1h, positions of the work": Dialect(
        "Grbl 1.1h ['$' for help]", "<{}|WPos:{}|F:0|WCO:0.000,0.000,0.000>"
    ),
    "grblHAL": Dialect(
        "GrblHAL 1.1f ['$' or '$HELP' for help]",
        "<{}|MPos:{}|Bf:100,1023|FS:0,0|Pn:PXYZ|WCO:0.000,0.000,0.000>",
        settings=GRBL + SETTINGS + "$70=7\r\n$74=lab wifi\r\n$302=192.168.5.1\r\n",
        reports_homing=True,
        lock="ALARM:11\r\n[MSG:'$H'|'$X' to unlock]",
    ),
    "FluidNC": Dialect(
        "Grbl 3.7 [FluidNC v3.7.8 (wifi) '$' for help]",
        "<{}|MPos:{}|FS:0,0>",
        settings=SETTINGS,
        chatter="ets Jul 29 2019\r\n\r\nrst:0x1 (POWERON_RESET)\r\n[MSG:INFO: FluidNC v3.7.8]",
    ),
    "a board whose greeting is lost": Dialect("", "<{}|MPos:{}|FS:0,0>"),
}
