"""The runs whose JSON documents are compared: fixed command lines on simulated recordings.

Every recording is simulated, with a seed, in the case's own folder; nothing else is read. Moves,
seeds and lengths are chosen: as short as still reaches the branch that the case is for, and such
that the platform meets no stop.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Case:
    """One command whose document is compared.

    Attributes
    ----------
    name
        Name of the case, and of its document's file.
    arguments
        Command line without the program and without ``--json``.
    recordings
        Command lines that make what it reads, carried out before in the same folder.
    added_truth
        TOML that makes ``my.toml`` of the preset sputnix: what happens to the platform.
    """

    name: str
    arguments: str
    recordings: tuple[str, ...] = ()
    added_truth: str = ""


CONTACT = """
[[truth.contact]]
time_s = 12.0
impulse_N_m_s = [0.01, -0.005, 0.0]
"""
COM_STEP = """
[[truth.com_step]]
time_s = 32.0
com_um = [20.0, -15.0, 0.0]
"""
EVENTFUL = (
    "simulate my.toml --out run.csv --duration-s 45 --seed 5 --move '20: x1=-10 y1=-10 z1=-50'"
)
MOVED = "simulate nanosat --out run.csv --duration-s 10 --seed 3 --move '5: x=0.2 y=-0.2 z=-2'"
FREE = "simulate unb --out run.csv --duration-s 15 --seed 3"

IDENTIFY = (
    Case(
        "identify_planned",
        "identify run.csv --testbed sputnix --plan plan.toml --prior --term viscous",
        (
            "plan sputnix --duration-s 30 --trials 20 --moves 1 --seed 5 --write plan.toml",
            "simulate sputnix --plan plan.toml --out run.csv --seed 3",
        ),
    ),
    Case(
        "identify_events",
        "identify run.csv --testbed my.toml --method trajectory --hold inertia_P_zz --robust",
        (EVENTFUL,),
        CONTACT + COM_STEP,
    ),
    # Ends with 1: the tracker says that it is not to be trusted after the contact.
    Case(
        "identify_tracker_contact",
        "identify run.csv --testbed my.toml --method tracker",
        (EVENTFUL,),
        CONTACT,
    ),
    # Ends with 1: the scale is open, and no body can have the inertia found.
    Case(
        "identify_momentum_body",
        "identify run.csv --testbed unb --method momentum_body",
        (FREE,),
    ),
    Case(
        "identify_momentum_corrected",
        "identify run.csv --testbed nanosat --method momentum_corrected",
        (MOVED,),
    ),
    Case("identify_ekf_9", "identify run.csv --testbed nanosat --method ekf_9 --to-s 6", (MOVED,)),
    Case(
        "identify_equilibrium",
        "identify run.csv --testbed cubesat-tas --method equilibrium",
        (
            "simulate cubesat-tas --out run.csv --duration-s 60 --seed 3"
            " --move '20: x=1' --move '40: y=1'",
        ),
    ),
    Case("identify_smoother", "identify run.csv --testbed nanosat --method smoother", (MOVED,)),
)
ASSESS = (
    Case(
        "assess_before_and_after",
        "assess run.csv --testbed sputnix --before before.csv --require-torque 1e-2",
        (
            "simulate sputnix --out before.csv --duration-s 25 --seed 3",
            "simulate sputnix --out run.csv --duration-s 25 --seed 3 --move '5: z1=-50 z2=-50'",
        ),
    ),
    # Ends with 1: the scale is open, and the offset is more than is allowed.
    Case(
        "assess_windows",
        "assess run.csv --testbed unb --require-offset-um 20 --windows-s 5",
        (FREE,),
    ),
)
BALANCE = (
    Case("balance_measure_and_move", "balance sputnix --seed 1"),
    # Ends with 1: there is no time to finish.
    Case(
        "balance_momentum_buildup",
        "balance reference-table --law momentum_buildup --max-time-s 60 --seed 2",
    ),
    Case("balance_manual", "balance weights-by-hand --manual --seed 1"),
)
CALIBRATE = (
    Case(
        "calibrate_held",
        "calibrate run.csv --testbed sputnix --hold inertia_P_zz",
        (
            "simulate sputnix --out run.csv --duration-s 60 --seed 5 --move '10: x1=10'"
            " --move '20: x1=20' --move '30: x1=0' --move '40: x1=-20' --move '50: x1=-10'",
        ),
    ),
    Case(
        "calibrate_reference",
        "calibrate run.csv --testbed nanosat --reference x",
        (
            "simulate nanosat --out run.csv --duration-s 24 --seed 3 --move '4: x=0.2'"
            " --move '8: y=0.2' --move '12: z=-10' --move '16: x=0' --move '20: y=-0.2'",
        ),
    ),
)
OTHERS = (
    Case("plan", "plan kau --duration-s 30 --trials 20 --moves 0 --seed 3"),
    Case(
        "compare",
        "compare reference-table --methods --laws --only trajectory,tracker,ekf_6"
        " --only pid,underactuated --runs 2 --duration-s 20 --max-time-s 40 --workers 1"
        " --move '10: coarse_x=20 coarse_z=20'",
    ),
    Case("observe", "observe run.csv --testbed unb", (FREE,)),
    Case("inspect", "inspect run.csv --testbed my.toml", (EVENTFUL,), CONTACT),
    Case("design", "design sputnix --record-s 30 60 --misalignment-deg 0.2 --bending-hz 40"),
)
CASES = (*IDENTIFY, *ASSESS, *BALANCE, *CALIBRATE, *OTHERS)


def chosen(names: list[str]) -> tuple[Case, ...]:
    """Return the cases of these names, or all if there are none."""
    by_name = {case.name: case for case in CASES}
    return tuple(by_name[name] for name in names) if names else CASES
