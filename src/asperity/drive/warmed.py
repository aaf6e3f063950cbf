"""A gearset that runs warm: what its housing and gears grow by, as errors of how it is mounted."""

from collections.abc import Iterator
from typing import NamedTuple, Protocol, Self

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.flanks.parameters import Modification, Mount
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.table import Tolerances
from asperity.gearset.tolerancing.warmth import Warmth

_MILLIMETRES, _MICRO = 1e3, 1e6


class Warmed(NamedTuple):
    """How a gearset stands when it is as warm as ``tolerances.temperatures`` says."""

    mount: Mount  #: That of the case with what warmth adds to the centre distance
    modification: Modification  #: That of the case with what warmth adds to the lead
    apart: float  #: What warmth adds to the centre distance, m
    pitch: float  #: Growth of the worm's pitch over that of the wheel's, less 1

    @classmethod
    def of(
        cls, case: Case, gearset: Gearset, mount: Mount | None, modification: Modification | None
    ) -> Self | None:
        """Return it of a gearset that is mounted and made so cold; None without temperatures.

        Raises
        ------
        InputError
            It would be further off than an error may be.
        """
        given = case.get(Tolerances)
        if given is None or given.temperatures is None:
            return None
        warmth = Warmth.of(gearset, given.temperatures, given.housing)
        mount, own = mount or Mount(), modification or Modification()
        apart = warmth.apart / _MILLIMETRES
        off = mount.centre_distance_error + apart
        lead = own.lead_correction + warmth.lead_correction(gearset.geometry.lead_angle)
        stands = {key: getattr(mount, key) for key in mount.model_fields_set}
        made = {key: getattr(own, key) for key in own.model_fields_set}
        return cls(
            Mount.model_validate(stands | {"centre_distance_error": off}),
            Modification.model_validate(made | {"lead_correction": lead}),
            apart,
            warmth.pitch,
        )

    @classmethod
    def asked(
        cls, case: Case, gearset: Gearset, mount: Mount | None, modification: Modification | None
    ) -> Self:
        """Return it where a case asks for it.

        Raises
        ------
        InputError
            The case says no temperatures; or as of `of`.
        """
        found = cls.of(case, gearset, mount, modification)
        if found is None:
            raise InputError(
                "drive.warm is true, and no temperatures are known; give tolerances.temperatures, "
                "such as { housing = '60 degC', gears = '80 degC' }, or leave drive.warm out"
            )
        return found

    @property
    def values(self) -> dict[str, float]:
        """Values of a case that has it so, by key."""
        return {
            "mount.centre_distance_error": self.mount.centre_distance_error,
            "modification.lead_correction": self.modification.lead_correction,
        }

    @property
    def told(self) -> str:
        """What warmth adds, in words."""
        return (
            f"centre distance {_MICRO * self.apart:+.3g} um, lead {_MICRO * self.pitch:+.3g} um/m"
        )


class _Standing(Protocol):
    """What stands warm or cold, such as a drive."""

    @property
    def warmed(self) -> Warmed | None:
        """What warmth has added to it."""

    @property
    def warmer(self) -> Warmed | None:
        """What warmth would add to it."""


def warmth(problem: _Standing) -> Iterator[str]:
    """Yield whether the gearset is warm or cold here, where the case says how warm it runs."""
    if (warmed := problem.warmed) is not None:
        yield (
            f"warm (drive.warm): tolerances.temperatures added {warmed.told} to what [mount] and "
            "[modification] say"
        )
    try:
        warmer = problem.warmer
    except InputError as error:
        yield f"cold: as warm as tolerances.temperatures say it does not stand ({error})"
        return
    if warmer is not None:
        yield (
            f"cold: tolerances.temperatures add {warmer.told} to what [mount] and [modification] "
            "say, which drive.warm = true puts in"
        )
