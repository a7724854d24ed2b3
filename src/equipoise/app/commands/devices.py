"""`equipoise devices`: what is connected to this computer."""

from equipoise.app.terminal import stdout


def devices() -> int:
    """List the serial ports of this computer, as a testbed file names them."""
    from equipoise.hardware.serial_ports import serial_ports

    found = serial_ports()
    for port in found:
        stdout().print(f"serial:{port.path}  {port.what}".rstrip(), markup=False)
    if not found:
        stdout().print("No serial port was found. Network devices are not listed.", markup=False)
    return 0
