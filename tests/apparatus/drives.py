"""Drives to try: a shipped one with a given mesh, changed by settings, and many at once."""

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.protocols.many import solve_many
from asperity.drive.reduced.reduction import reduction
from asperity.drive.solve import answer, prepare
from asperity.errors import AsperityError
from asperity.runs import Run

# Deflection of the middle tooth of a sector of five, urad at N m; the law of a tooth cut out of the
# wheel is that, scaled to 542 urad at 366 N m.
POINTS = ((23.0, 47.6), (100.0, 143.0), (366.0, 365.0), (1000.0, 708.0))


def deflection(angle=365.0):
    """Return the setting of a contact law that gives an angle, urad, at 366 N m."""
    pairs = ", ".join(f'["{torque} N m", "{at * angle / 365.0} urad"]' for torque, at in POINTS)
    return f"drive.deflection=[{pairs}]"


# A mesh with these needs no static solution of teeth.
GIVEN = (
    deflection(), "drive.effective_radius=9.81 mm", "drive.tangential_compliance=2.9 nm/N",
)  # fmt: skip
ASPERITIES = "drive.tangential_compliance=0 m/N"


def case(*settings, name="drive-screw"):
    return read_case(name, case_tables(), [*GIVEN, *settings])


def problem(*settings, name="drive-screw"):
    return prepare(case(*settings, name=name))


def solved(*settings, name="drive-screw"):
    return answer(problem(*settings, name=name), Run())


def all_solved(settings, name="drive-screw"):
    """Return the answers to many drives, each given by its settings; raises what they raise."""
    problems = [problem(*each, name=name) for each in settings]
    found = solve_many([(each, reduction(each, Run())) for each in problems], Run())
    for each in found:
        if isinstance(each, AsperityError):
            raise each
    return found
