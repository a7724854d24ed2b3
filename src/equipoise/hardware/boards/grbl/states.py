"""What the states of a Grbl board mean to its driver. Source: Grbl 1.1 wiki, "Interface"."""

from equipoise.hardware.boards.grbl.report import MachineState
from equipoise.hardware.transport.driver_protocol import POLL_HALTED, POLL_MOVING, Phase

POLLS = {Phase.MOVING: POLL_MOVING, Phase.HOMING: POLL_MOVING, Phase.HALTED: POLL_HALTED}
QUIET = (MachineState.IDLE, MachineState.ALARM)  # it takes the lines that begin a homing
TAKES_LEGS = (MachineState.IDLE, MachineState.JOG)
LOST = (MachineState.ALARM, MachineState.SLEEP)  # the position may not be true any more
WAYS_OUT = {  # in which nothing moves, and how they are called for people
    MachineState.ALARM: "it is locked",
    MachineState.HOLD: "its motion is held",
    MachineState.CHECK: "it answers and moves nothing ($C)",
    MachineState.DOOR: "its safety door is open",
    MachineState.SLEEP: "its motors are off ($SLP)",
    MachineState.TOOL: "it waits for a change of tools",
    MachineState.HOME: "it homes, and was not sent home",
}
