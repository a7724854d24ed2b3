"""`equipoise devices`: what is connected to this computer."""

from equipoise.app.arguments.options import Flag


def devices(*, json: Flag = False) -> int:
    """List the serial ports of this computer, as a testbed file names them.

    Parameters
    ----------
    json
        Print one JSON document instead.
    """
    from equipoise.app.console.rich_blocks import show
    from equipoise.app.text.blocks import paragraphs
    from equipoise.app.text.json_document import dump
    from equipoise.app.text.json_lists import DEVICES
    from equipoise.hardware.transport.serial_ports import serial_ports

    found = serial_ports()
    if json:
        print(dump(DEVICES.write({"serial": found})))
        return 0
    none = "No serial port was found. Network devices are not listed."
    show(paragraphs(*[f"serial:{p.path}  {p.what}".rstrip() for p in found] or [none]))
    return 0
