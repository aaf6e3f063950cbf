"""The `[friction]` table: which law, with which numbers."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.friction.dahl import LAWS
from asperity.friction.loaded import KEEPS
from asperity.units import Quantity


class Friction(Table):
    r"""Friction between body and base.

    Parameters
    ----------
    model : {'coulomb', 'dahl', 'lugre', 'springs'}
        Rigid Coulomb friction, Dahl's elastic asperity, LuGre (Dahl with a Stribeck curve and
        damping), or plastic asperities at the heights that carry the normal law.
    mu : float
        Coefficient of kinetic friction :math:`\mu > 0`.
    max_deflection : float or str, optional
        Deflection of the asperities at full friction, :math:`s_{max}`, m. Give this or
        ``tangential_stiffness`` (not for Coulomb).
    tangential_stiffness : float or str, optional
        :math:`k_t = \mu F_N / s_{max}`, N/m; thesis (18).
    exponent : float
        Dahl's exponent :math:`i \ge 0`: 0 brittle, 1 (default) to 2 ductile; thesis (4).
    law : {'vector', 'unsplit', 'split'}
        How the deflection relaxes in two dimensions, see `asperity.friction.dahl`.
    transfer : float
        :math:`\eta_y`, share of the lateral vibration that reaches the contact, 0..1; thesis (32).
        The thesis's 0.71 was fitted with law ``split``.
    static_mu : float, optional
        LuGre: coefficient of static friction :math:`F_S/F_N`; left out: ``mu``.
    stribeck_velocity : float or str
        LuGre: :math:`v_s`, m/s; 0 for no Stribeck effect.
    contact_damping, viscous_damping : float or str
        LuGre: :math:`h_t` on the deflection's rate and :math:`h_v` on the slip, N s/m; between
        teeth at the normal force without vibration, with which they go.
    keeps : {'stiffness', 'deflection'}
        What Dahl's and LuGre's asperities keep where the normal force changes, see
        `asperity.friction.loaded`. ``deflection`` gains energy.
    springs : int
        Number of springs, 1..256.
    load_exponent : float
        :math:`n` of friction :math:`\sim F_N^n` where the normal force changes, above 0 to 2; 1 is
        Coulomb's, 2/3 an area that grows as that of Hertz.
    """

    table: ClassVar[str] = "friction"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("max_deflection", "tangential_stiffness"),
    )

    model: Literal["coulomb", "dahl", "lugre", "springs"] = "dahl"
    mu: Annotated[
        float, Quantity("", what="a coefficient of friction", example="0.1", gt=0, le=100)
    ]
    max_deflection: (
        Annotated[float, Quantity("m", what="a deflection", example="68.75 nm", gt=0)] | None
    ) = None
    tangential_stiffness: (
        Annotated[float, Quantity("N/m", what="a stiffness", example="80 MN/m", gt=0)] | None
    ) = None
    exponent: Annotated[float, Quantity("", what="an exponent", example="1.0", ge=0, le=10)] = 1.0
    law: Literal["split", "unsplit", "vector"] = "vector"
    transfer: Annotated[float, Quantity("", what="a share", example="0.71", ge=0, le=1)] = 1.0
    static_mu: (
        Annotated[float, Quantity("", what="a coefficient of friction", example="0.15", gt=0)]
        | None
    ) = None
    stribeck_velocity: Annotated[
        float, Quantity("m/s", what="a velocity", example="1 mm/s", ge=0)
    ] = 0.0
    contact_damping: Annotated[
        float, Quantity("N s/m", what="a damping", example="300 N s/m", ge=0)
    ] = 0.0
    viscous_damping: Annotated[
        float, Quantity("N s/m", what="a damping", example="0.4 N s/m", ge=0)
    ] = 0.0

    keeps: Literal["stiffness", "deflection"] = "stiffness"
    springs: Annotated[int, Field(strict=True, ge=1, le=256)] = 16
    load_exponent: Annotated[
        float, Quantity("", what="an exponent", example="0.667", gt=0, le=2)
    ] = 1.0

    @model_validator(mode="after")
    def _consistent(self) -> "Friction":
        given = self.model_fields_set
        elastic = self.max_deflection is not None or self.tangential_stiffness is not None
        if self.model != "coulomb" and not elastic:
            raise InputError(
                f"friction.max_deflection is missing; model '{self.model}' needs it, or "
                "friction.tangential_stiffness"
            )
        if self.model != "springs" and "springs" in given:
            raise InputError(
                f"friction.springs is for model 'springs'; the model is '{self.model}': leave it "
                "out or change friction.model"
            )
        if self.model == "coulomb" and "keeps" in given and self.keeps != "deflection":
            raise InputError(
                f"friction.keeps is '{self.keeps}'; asperities of model 'coulomb' do not deflect, "
                "and their friction follows the normal force at once: leave it out"
            )
        if self.model == "springs":
            self._as_springs()
        if self.model != "lugre":
            for key in ("static_mu", "stribeck_velocity", "contact_damping", "viscous_damping"):
                if key in given and getattr(self, key):
                    raise InputError(
                        f"friction.{key} is for model 'lugre'; the model is '{self.model}': "
                        "leave it out or change friction.model"
                    )
        elif self.exponent != 1.0:
            raise InputError(f"friction.exponent is {self.exponent:g}; LuGre knows exponent 1 only")
        elif self.static_mu is not None and self.static_mu < self.mu:
            raise InputError(
                f"friction.static_mu is {self.static_mu:g}; it must not be below "
                f"friction.mu = {self.mu:g}"
            )
        elif (self.static_mu or self.mu) > self.mu and self.stribeck_velocity == 0.0:
            raise InputError(
                "friction.static_mu is above friction.mu, so friction.stribeck_velocity must be "
                "given (how fast static friction is lost)"
            )
        return self

    def _as_springs(self) -> None:
        """Refuse what springs have none of."""
        if self.exponent != 1.0:
            raise InputError(
                f"friction.exponent is {self.exponent:g}; springs have none, how they yield "
                "follows from the normal law (linear as exponent 0, hertz 1/3, rough 1): leave it "
                "out"
            )
        if self.law != "vector":
            raise InputError(
                f"friction.law is '{self.law}'; springs yield along their deflection, which is "
                "'vector': leave it out"
            )
        if self.keeps != "stiffness":
            raise InputError(
                f"friction.keeps is '{self.keeps}'; springs keep their stiffness: leave it out"
            )

    @property
    def law_code(self) -> int:
        """Number of the law in the compiled kernels."""
        return LAWS[self.law]

    @property
    def keeps_code(self) -> int:
        """Number of what the asperities keep in the compiled kernels."""
        return KEEPS[self.keeps]

    def deflection_limit(self, normal_force: float) -> float:
        r""":math:`s_{max}`, m, under a normal force in N.

        Parameters
        ----------
        normal_force : float
            :math:`F_N`, N.

        Returns
        -------
        float
            :math:`s_{max}`, m: as it is given, or :math:`\mu F_N/k_t`; thesis (18).

        Raises
        ------
        InputError
            The friction is Coulomb's, or so stiff that full friction deflects nothing.
        """
        if self.max_deflection is not None:
            return self.max_deflection
        if self.tangential_stiffness is None:
            raise InputError("Coulomb friction has no deflection")
        limit = self.mu * normal_force / self.tangential_stiffness
        if limit <= 0.0:
            raise InputError(
                f"friction.tangential_stiffness is {self.tangential_stiffness:g} N/m, so stiff that"
                f" the friction force of {self.mu * normal_force:.3g} N deflects nothing; look for "
                "a wrong unit or exponent"
            )
        return limit

    def stiffness(self, normal_force: float) -> float:
        r""":math:`k_t`, N/m, under a normal force in N; thesis (18).

        Parameters
        ----------
        normal_force : float
            :math:`F_N` of the contact, N.

        Returns
        -------
        float
            :math:`k_t = \mu F_N/s_{max}`, N/m.

        Raises
        ------
        InputError
            As of `deflection_limit`.
        """
        return self.mu * normal_force / self.deflection_limit(normal_force)
