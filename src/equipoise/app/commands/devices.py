"""`equipoise devices`: what is connected to this computer."""

from equipoise.app.arguments.options import Json


def devices(*, json: Json = False) -> int:
    """List the serial ports of this computer."""
    from equipoise.app.logbook.output import print_result
    from equipoise.app.text.blocks import paragraphs
    from equipoise.app.text.json_lists import DEVICES
    from equipoise.hardware.transport.serial_ports import serial_ports

    found = serial_ports()
    none = "No serial port was found. Network devices are not listed."
    blocks = paragraphs(*[f"serial:{p.path}  {p.what}".rstrip() for p in found] or [none])
    print_result(DEVICES.write({"serial": found}), blocks, json)
    return 0
