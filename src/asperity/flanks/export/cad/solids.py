"""Tooth, worm and wheel as closed solids, one by one: a part that does not close costs no other."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from asperity.errors import ConvergenceError
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.cad.brep import solid
from asperity.flanks.export.cad.keyway import keyed
from asperity.flanks.export.cad.step import Component, write_assembly, write_step
from asperity.flanks.export.extras import require_cad
from asperity.flanks.export.patch import Body
from asperity.flanks.export.space.scene import BRONZE, STEEL
from asperity.flanks.export.tooth import tooth_body, wheel_body
from asperity.flanks.export.turned import Beside
from asperity.flanks.export.worm import wheel_shaft, whole_worm
from asperity.flanks.wheel.enveloped import Wheel

_BOTH = "worm", "wheel"


@dataclass(frozen=True)
class Solids:
    """Solids of a gearset, where they stand in mesh.

    Attributes
    ----------
    parts : mapping of str to Component
        ``tooth``, ``worm``, ``wheel`` and, where there is one, ``wheel_shaft``: what closes.
    refused : mapping of str to str
        Why one of them is missing.
    """

    parts: Mapping[str, Component]
    refused: Mapping[str, str]

    @classmethod
    def of(cls, wheel: Wheel, assembly: Assembly, beside: Beside = None) -> "Solids":
        """Make the solids of a gearset; raises MissingExtraError without the ``cad`` extra."""
        require_cad()
        middle, still = np.zeros(3), np.eye(3)
        bodies: dict[str, Callable[[], Body]] = {
            "tooth": lambda: tooth_body(wheel),
            "worm": lambda: whole_worm(assembly.pair, beside),
            "wheel": lambda: wheel_body(wheel, beside),
        }
        stands = {
            "tooth": (still, middle, BRONZE),
            "worm": (assembly.worm_rotation, assembly.worm_place, STEEL),
            "wheel": (assembly.wheel_rotation, middle, BRONZE),
        }
        shaft = wheel_shaft(beside)
        if shaft is not None:
            bodies["wheel_shaft"] = lambda: shaft
            stands["wheel_shaft"] = assembly.wheel_rotation @ assembly.shaft_turn, middle, STEEL
        parts, refused = {}, {}
        for name, body in bodies.items():
            try:
                parts[name] = Component(keyed(solid(body()), assembly.pair, beside), *stands[name])
            except ConvergenceError as error:
                refused[name] = str(error)
        return cls(parts, refused)

    @property
    def failure(self) -> ConvergenceError | None:
        """Which files are missing, why, and what to change; None where none is."""
        if not self.refused:
            return None
        missing = [f"{name}.step" for name in self.refused]
        if not self.refused.keys().isdisjoint(_BOTH):
            missing.append("gearset.step")
        return ConvergenceError(
            f"{' and '.join(missing)} cannot be written, all else is: "
            f"{'; '.join(self.refused.values())}; another hob.tip_radius or a narrower "
            "gearset.wheel_face_width may close them"
        )

    def write(self, folder: Path, name: str = "worm gearset") -> list[str]:
        """Write each as STEP, and worm and wheel in mesh by a name; return the files' names."""
        names = []
        for part, component in self.parts.items():
            names.append(f"{part}.step")
            write_step(folder / names[-1], component.solid)
        if self.refused.keys().isdisjoint(_BOTH):
            names.append("gearset.step")
            mounted = [part for part in (*_BOTH, "wheel_shaft") if part in self.parts]
            write_assembly(folder / names[-1], name, [self.parts[part] for part in mounted])
        return names
