"""`equipoise check`: talk to each device, and say what is wrong in words."""

from typing import TYPE_CHECKING

from equipoise.app.arguments.options import Flag
from equipoise.app.console.terminal import agreed, announced, busy, stdout

if TYPE_CHECKING:
    from equipoise.app.bench.check_result import CheckResult

STREAMED = 2.0  # s of every sensor, as the usage says


def check(testbed: str, /, *, yes: Flag = False, explain: Flag = False) -> int:
    """Test every device of a real bench; move each mass by 1 mm and back.

    Masses go home first. Turn the platform a little by hand while the sensors stream, so that the
    signs of gyro and attitude can be compared. Exit code 1: something is wrong.

    Parameters
    ----------
    testbed
        Testbed file with a [hardware] table.
    yes
        Move masses and drive devices without confirmation.
    explain
        Print and explain the conversation with each device as it happens.
    """
    from equipoise.app.arguments.inputs import testbed_from
    from equipoise.app.bench.bench_check import checked_bench
    from equipoise.app.bench.emulation import hardware_of
    from equipoise.app.bench.explained_conversation import Conversations
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.blocks import items
    from equipoise.hardware.bench.open_port import open_port

    def print_line(line: str) -> None:
        stdout().print(line, style="dim", soft_wrap=True)

    bed = announced(testbed_from(testbed))
    reported: list[CheckResult] = []
    with busy("talking to the devices", announce=False):
        opener = Conversations(hardware_of(bed), print_line).open if explain else open_port
        steps = checked_bench(bed, STREAMED, (lambda _: True) if yes else agreed, opener)
        for line in steps:
            show(items((line.sentence,), "good" if line.good else "bad"))
            reported.append(line)
    return 0 if all(line.good for line in reported) else 1
