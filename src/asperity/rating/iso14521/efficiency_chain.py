"""ISO/TR 14521's way from the geometry to the efficiency, for one gearset or for a million."""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError
from asperity.gearset.materials import BaseOilName, WheelMaterial
from asperity.rating.formula import Argument, FloatArray, Invalid, angle
from asperity.rating.iso14521.block import REASONS, Options, follow
from asperity.rating.iso14521.tables import Edition, Flank, Lubrication, check_words

_UNITS = {
    "axial_module": "mm",
    "centre_distance": "mm",
    "wheel_face_width": "mm",
    "worm_speed": "rpm",
    "worm_roughness": "um",
    "output_torque": "N m",
}

# The arrays of one block stay in the processor's cache together.
_BLOCK = 32768


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Chain:
    r"""Friction, efficiency and losses, each a float or an array of the inputs' common shape.

    Attributes
    ----------
    profile_shift, centre_distance : float or ndarray
        :math:`x_2`; :math:`a`, mm.
    lead_angle, sliding_velocity : float or ndarray
        :math:`\gamma_{m1}`, rad; :math:`v_{gm}`, m/s.
    film_parameter, base_friction : float, ndarray or None
        :math:`h^*`, :math:`\mu_{0T}`; these and the factors are None where the mean friction was
        given.
    size_factor, geometry_factor, material_factor, roughness_factor : float, ndarray or None
        :math:`Y_S`, :math:`Y_G`, :math:`Y_W`, :math:`Y_R`.
    mean_friction : float or ndarray
        :math:`\mu_{zm}`.
    efficiency, back_driving_efficiency : float or ndarray
        :math:`\eta_{z1-2}`, :math:`\eta_{z2-1}`.
    output_power, loss_meshing, loss_idle : float, ndarray or None
        :math:`P_2`, :math:`P_{Vz}`, :math:`P_{V0}`, W; these and the rest are None without an
        output torque.
    loss_bearing, loss_seal, input_power : float, ndarray or None
        :math:`P_{VLP}`, :math:`P_{VD}`, and the sum of all :math:`P_1`, W.
    total_efficiency : float, ndarray or None
        :math:`\eta_{ges1-2}`.
    reason : int or ndarray of int
        0 where there is an answer; elsewhere the numbers above are NaN, and this is the code of
        the reason.
    legend : mapping of int to str
        The codes as sentences.
    """

    profile_shift: Any
    centre_distance: Any
    lead_angle: Any
    sliding_velocity: Any
    film_parameter: Any = None
    base_friction: Any = None
    size_factor: Any = None
    geometry_factor: Any = None
    material_factor: Any = None
    roughness_factor: Any = None
    mean_friction: Any
    efficiency: Any
    back_driving_efficiency: Any
    output_power: Any = None
    loss_meshing: Any = None
    loss_idle: Any = None
    loss_bearing: Any = None
    loss_seal: Any = None
    input_power: Any = None
    total_efficiency: Any = None
    reason: Any
    legend: Mapping[int, str] = dataclasses.field(repr=False)


def chain(
    *,
    starts: npt.ArrayLike,
    wheel_teeth: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    centre_distance: npt.ArrayLike | None = None,
    profile_shift: npt.ArrayLike | None = None,
    pressure_angle: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    worm_roughness: npt.ArrayLike,
    material: str | WheelMaterial | Sequence[str | WheelMaterial],
    base_oil: BaseOilName | Sequence[BaseOilName],
    lubrication: Lubrication = "bath",
    output_torque: npt.ArrayLike | None = None,
    loss_coefficient: npt.ArrayLike = 0.013,
    seals: npt.ArrayLike = 2,
    wheel_face_width: npt.ArrayLike | None = None,
    base_friction: npt.ArrayLike | None = None,
    friction: npt.ArrayLike | None = None,
    friction_factor: npt.ArrayLike = 1.0,
    edition: Edition = "2010",
    flank: Flank = "ZI",
    on_invalid: Invalid = "raise",
) -> Chain:
    r"""Follow the standard from the geometry to the efficiency.

    Parameters
    ----------
    starts, wheel_teeth : array_like
        :math:`z_1`, :math:`z_2`; need not be whole, so that a ratio can be varied smoothly.
    diameter_factor : array_like
        :math:`q_1`.
    axial_module : array_like
        :math:`m_{x1}`, mm.
    centre_distance, profile_shift : array_like
        :math:`a`, mm, or :math:`x_2`: one of them, the other follows.
    pressure_angle : array_like
        :math:`\alpha_n`, rad.
    worm_speed : array_like
        :math:`n_1`, rpm.
    worm_roughness : array_like
        :math:`Ra_1`, um.
    material : str, WheelMaterial or array of them
        Of the wheel.
    base_oil : {'mineral', 'polyalphaolefin', 'polyglycol'} or array of them
        Of the lubricant.
    lubrication : {'bath', 'spray'}
        How it gets there.
    output_torque : array_like, optional
        :math:`T_2`, N m; without it the chain ends at the efficiency of the teeth.
    loss_coefficient : array_like
        Of the bearings, see `bearing_loss`.
    seals : array_like
        Number of lip seals on the worm.
    wheel_face_width : array_like, optional
        :math:`b_{2H}`, mm, see `film_parameter`.
    base_friction, friction : array_like, optional
        In place of :math:`\mu_{0T}`; in place of :math:`\mu_{zm}`. One of them at most.
    friction_factor : array_like
        Multiplies :math:`\mu_{zm}`.
    edition, flank : str
        See `film_parameter`.
    on_invalid : {'raise', 'mask'}
        Whether an array with a gearset that has no answer raises, or says so in ``reason``. A
        single gearset always raises.

    Returns
    -------
    Chain
        Floats where every input is a number, else arrays.

    Raises
    ------
    FilmParameterError
        :math:`h^*` is not above zero.
    InputError
        Something given is not allowed, the worm's pitch diameter reaches the wheel's axis, or the
        worm cannot drive.

    Examples
    --------
    >>> gearset = chain(
    ...     starts=1, wheel_teeth=60, diameter_factor=10.8, axial_module=1.70,
    ...     centre_distance=60.17, pressure_angle=np.radians(20), worm_speed=1440,
    ...     worm_roughness=1.6, material="CuAl10Fe5Ni5-C-GZ", base_oil="mineral", output_torque=66,
    ... )
    >>> round(gearset.efficiency, 3), round(gearset.total_efficiency, 3)
    (0.379, 0.312)
    """
    check_words(edition=edition, flank=flank, lubrication=lubrication)
    if on_invalid not in ("raise", "mask"):
        raise InputError(f"on_invalid is {on_invalid!r}; it must be 'raise' or 'mask'")
    if (centre_distance is None) == (profile_shift is None):
        raise InputError("give one of centre_distance and profile_shift; the other follows")
    if base_friction is not None and friction is not None:
        raise InputError("give base_friction or friction, not both: friction replaces them all")
    given: dict[str, Any] = {
        "starts": starts,
        "wheel_teeth": wheel_teeth,
        "diameter_factor": diameter_factor,
        "axial_module": axial_module,
        "centre_distance": centre_distance,
        "profile_shift": profile_shift,
        "pressure_angle": pressure_angle,
        "worm_speed": worm_speed,
        "worm_roughness": worm_roughness,
        "output_torque": output_torque,
        "loss_coefficient": loss_coefficient,
        "seals": seals,
        "wheel_face_width": wheel_face_width,
        "base_friction": base_friction,
        "friction": friction,
        "friction_factor": friction_factor,
    }
    arguments = [_argument(name, value) for name, value in given.items() if value is not None]
    words = {"material": _words(material), "base_oil": _words(base_oil)}
    columns: dict[str, Any] = {argument.name: argument.array() for argument in arguments} | words
    try:
        shape = np.broadcast_shapes(*(column.shape for column in columns.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {c.shape}" for name, c in columns.items() if c.shape)
        raise InputError(f"the shapes {shapes} do not go together; make them equal") from None
    size = int(np.prod(shape))
    columns = {
        name: np.broadcast_to(column, shape).reshape(size) if column.ndim else column
        for name, column in columns.items()
    }
    masking = on_invalid == "mask" and shape != ()
    options = Options(lubrication, edition, flank, masking)
    reason = np.zeros(size, dtype=np.int8)
    results: dict[str, FloatArray] = {}
    for start in range(0, max(size, 1), _BLOCK):
        part = slice(start, start + _BLOCK)
        block = {name: c[part] if c.ndim else c for name, c in columns.items()}
        reason[part], answers = follow(arguments, block, min(_BLOCK, size - start), options)
        for name, values in answers.items():
            results.setdefault(name, np.empty(size))[part] = values
    legend = {0: "there is an answer", **REASONS} | {
        code: f"{argument.name} is not allowed; {argument.allowed()}"
        for code, argument in enumerate(arguments, 1)
    }
    if shape == ():
        return Chain(**{k: float(v[0]) for k, v in results.items()}, reason=0, legend=legend)
    shaped = {name: values.reshape(shape) for name, values in results.items()}
    return Chain(**shaped, reason=reason.reshape(shape), legend=legend)


def _argument(name: str, value: npt.ArrayLike) -> Argument:
    if name == "pressure_angle":
        return angle(name, value)
    if name == "profile_shift":
        return Argument(name, value, "", -1e3, 1e3)
    if name in ("friction", "friction_factor", "seals", "loss_coefficient"):
        return Argument(name, value, "", 0.0, 1e3)
    # Beyond these nobody builds, and no power of them overflows.
    lower = 1.6 if name == "diameter_factor" else 1e-6
    return Argument(name, value, _UNITS.get(name, ""), lower, 1e6)


def _words(given: Any) -> npt.NDArray[Any]:
    array = np.asarray(given)
    return array if array.dtype.kind == "U" else np.asarray(given, dtype=object)
