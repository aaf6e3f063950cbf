"""``asperity rexs``: a case's gearset as a file of the exchange format REXS."""

import os
from importlib.metadata import version
from pathlib import Path
from typing import ClassVar

from asperity.casefile import Case, naming_source
from asperity.errors import InputError
from asperity.files.store import write_text
from asperity.flanks.export.rexs.carried import carried_of, left_out, with_carried
from asperity.flanks.export.rexs.components import WormStage
from asperity.flanks.export.rexs.document import VERSION, Document
from asperity.flanks.export.rexs.gearset import document
from asperity.flanks.parameters import Disc, Hob, Mount
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate
from asperity.rating.driven import driven
from asperity.rating.inputs import inputs
from asperity.rating.rate import run_of
from asperity.results import Result, quantity
from asperity.results.table import Table
from asperity.runs import Run
from asperity.shafts.parameters import WheelShaft, WormShaft

_APPLICATION = "asperity"


class Exchanged(Result):
    """A gearset as a REXS model.

    Attributes
    ----------
    name : str
        Of the gearset.
    document : Document
        The model.
    """

    title: ClassVar[str] = "REXS model"
    stem: ClassVar[str] = "rexs"

    name: str
    rexs: str = quantity("", "", "version of REXS")
    components: int = quantity("", "", "components")
    attributes: int = quantity("", "", "attributes")
    relations: int = quantity("", "", "relations")
    load_cases: int = quantity("", "", "load cases")
    document: Document

    def heading(self) -> str:
        """Return what it is of."""
        return f"{self.name or 'worm gearset'} as REXS {self.rexs}"

    def tables(self) -> tuple[Table, ...]:
        """Return what it holds."""
        counts: dict[str, int] = {}
        for one in self.document.components:
            counts[one.type] = counts.get(one.type, 0) + 1
        rows = list(counts.items())
        return (*super().tables()[:1], Table.of(("component", "number"), rows))

    def text(self) -> str:
        """Return it as the text of a file."""
        return self.document.xml(_APPLICATION, version(_APPLICATION))

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the model, whole or not at all."""
        return write_text(path, self.text())


def prepare(case: Case) -> WormStage:
    """Return what is written of a case; raises InputError."""
    gearset = case.require(Gearset).require_consistent()
    operation = None if case.get(Operation) is None else run_of(case)
    options = case.get(RatingOptions)
    stage = WormStage(
        gearset, None, case.get(Hob), case.get(Disc), case.get(Mount),
        worm_shaft=case.get(WormShaft), wheel_shaft=case.get(WheelShaft),
        carried=carried_of(case), left_out=tuple(left_out(case)),
    )  # fmt: skip
    if operation is None:
        return stage
    with naming_source(case):
        operation = driven(gearset, operation, options)
    steps = tuple(
        (float(part.hours), float(part.torque), float(part.speed))
        for part in inputs(gearset, operation, options or RatingOptions()).duty
    )
    stage = stage._replace(operation=operation, sump=operation.oil_temperature, steps=steps)
    try:
        rated = rate(gearset, operation, options, ("iso14521",), folder=case.folder)
    except InputError:
        return stage
    clockwise = next((one for one in rated.forces if one.rotation == "clockwise"), None)
    return stage._replace(forces=clockwise)


def answer(stage: WormStage, _: Run) -> Exchanged:
    """Return the model of a case."""
    made = with_carried(document(stage), stage.carried)
    notes = ["results of a rating are left out: the format has names for those of DIN 3996:2019"]
    if stage.carried:
        listed = ", ".join(f"[{name}]" for name in stage.carried)
        notes.append(
            f"carried in an attribute of our own, which other programs pass over: {listed}"
        )
    if stage.left_out:
        notes.append(f"left out: {', '.join(stage.left_out)}")
    factor = None if stage.operation is None else stage.operation.application_factor
    if stage.forces is not None and factor != 1.0:
        notes.append(
            f"forces of the teeth are those under K_A T_2, K_A {factor:g}; torques are without it"
        )
    for part in ("worm", "wheel"):
        if getattr(stage, f"{part}_shaft") is None:
            notes.append(
                f"the {part}'s shaft is a plain one with bearings at either side: the case has no "
                f"[{part}_shaft]"
            )
    if stage.operation is None:
        notes.append("the case has no [operation]: speed, torque and oil are left out")
    return Exchanged(
        name=stage.gearset.name,
        rexs=VERSION,
        components=len(made.components),
        attributes=sum(len(one.attributes) for one in made.components),
        relations=len(made.relations),
        load_cases=len(made.load_cases),
        document=made,
        notes=tuple(notes),
    )
