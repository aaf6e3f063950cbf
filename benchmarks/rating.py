"""How fast variants of a worm gearset are rated, against other ways in the same run.

Run it with ``make bench``. Every line gives a time and a ratio: on a shared machine only the ratio
means something, but for two times that are held as bounds: of a million variants with three steps,
and of a spectrum of ten thousand. All runs are on one core. The other ways: a loop of the package's
single calls, and the formulas written down plainly for floats, unchecked.
"""

import math

import numpy as np
from _common import best, finish, on_one_core

from asperity import size
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, Spectrum, rate, variants
from asperity.rating.iso14521.tables import friction_constants

VARIANTS = 1_000_000
SINGLE = 100
PLAIN = 20_000
TARGET_S = 2.0
PROPOSALS_S = 1.0
MILLION_OF_THREE_S = 1.5
TEN_THOUSAND_S = 0.5
ONE_BY_ONE_OVER_PROPOSALS = 20.0
ASKED = 10.0, "20 N m", "3000 rpm"
RPM = math.pi / 30.0

GEARSET = Gearset(
    starts=2,
    wheel_teeth=40,
    axial_module=4e-3,
    diameter_factor=10.0,
    profile_shift=0.0,
    worm_material="case-hardened steel",
    wheel_material="CuAl10Fe5Ni5-C-GZ",
    units="SI",
)
OPERATION = Operation(
    worm_speed=150.0, output_torque=300.0, lubricant="ISO VG 220 mineral", units="SI"
)
TOTAL = "iso14521.eta_ges"


def columns(count):
    """Gearsets of one to four starts with everything varied at once, in SI."""
    rng = np.random.default_rng(14521)
    return {
        "starts": rng.choice([1.0, 2.0, 4.0], count),
        "wheel_teeth": rng.integers(30, 81, count).astype(float),
        "diameter_factor": rng.uniform(6.0, 14.0, count),
        "axial_module": rng.uniform(1e-3, 10e-3, count),
        "profile_shift": rng.uniform(-0.5, 0.5, count),
        "pressure_angle": np.radians(rng.uniform(14.5, 30.0, count)),
        "worm_speed": RPM * rng.uniform(100.0, 3000.0, count),
        "worm_roughness": rng.uniform(0.4e-6, 3.2e-6, count),
        "output_torque": rng.uniform(10.0, 1000.0, count),
    }


def rated(given, capacity=False):
    """Rate by the standard all at once."""
    standard = ("iso14521",)
    return variants(GEARSET, OPERATION, RatingOptions(), standard, capacity=capacity, **given)


def plain(row, law, material_factor):
    """The same formulas as one writes them first, with nothing checked."""
    z1, z2, q, m = (row[k] for k in ("starts", "wheel_teeth", "diameter_factor", "axial_module"))
    m, n_1, torque, x_2 = 1e3 * m, row["worm_speed"] / RPM, row["output_torque"], row["shift"]
    a = 0.5 * m * (q + z2 + 2.0 * x_2)
    d_m1, u, r = q * m, z2 / z1, z1 / q
    d_m2 = 2.0 * a - d_m1
    lead = math.atan(r)
    v = d_m1 * n_1 / (19098.0 * math.cos(lead))
    b = math.sqrt(6.0 * m * d_m1 - 9.0 * m * m + m)
    h = -0.393 + 2.9157e-6 * (
        z2**-0.0847 * math.degrees(row["pressure_angle"]) ** 0.0595
        * (7.947e-7 * x_2 + 5.927e-5) * ((1.0 - 0.038 * q) * q + 65.576)
        * ((108.8547 * r - 1.0) * r - 3294.921) * ((0.003291 * b + 1.0) * b - 13064.58)
    )  # fmt: skip
    if h <= 0.0:
        return math.nan
    mu = min(law.offset + law.gain / (v + law.shift) ** law.exponent, law.cap) * material_factor
    mu *= math.sqrt(100.0 / a) * math.sqrt(0.07 / h) * (1e6 * row["worm_roughness"] / 0.5) ** 0.25
    eta = math.tan(lead) / math.tan(lead + math.atan(mu))
    power = 2.0 * math.pi / 60.0 * torque * n_1 / u
    lost = 0.1 * torque * n_1 / u * (1.0 / eta - 1.0) + 0.89e-4 * a * n_1 ** (4.0 / 3.0)
    lost += 0.013 * power * a**0.44 * u / d_m2 + 2.0 * 11.78e-6 * d_m1 * d_m1 * n_1
    return power / (power + lost)


def plainly(given, count):
    """Rate the first gearsets in a loop of plain formulas."""
    law = friction_constants("aluminium bronze", "bath", "mineral")
    factor = GEARSET.wheel_material.material_factor
    names = ["shift" if name == "profile_shift" else name for name in given]
    rows = zip(*(values[:count].tolist() for values in given.values()), strict=True)
    return np.array([plain(dict(zip(names, row, strict=True)), law, factor) for row in rows])


def one_by_one(given, count):
    """Rate the first gearsets in a loop of calls for one."""
    answers = []
    for i in range(count):
        one = {name: values[i : i + 1] for name, values in given.items()}
        try:
            answers.append(rated(one)[TOTAL][0])
        except InputError:
            answers.append(np.nan)
    return np.array(answers)


def spectra(given):
    """Rate a million gearsets under three loads, and one under ten thousand with as many speeds."""
    loads = [(1.0, 1.0), (0.6, 3.0), (0.24, 6.0)]

    def operation(steps, slower=0.0):
        torque, speed = OPERATION.output_torque, OPERATION.worm_speed
        made = [
            {
                "duration": 3.6e6 * hours,
                "output_torque": torque * share,
                **({"worm_speed": speed * (1.0 - slower * share)} if slower else {}),
            }
            for share, hours in steps
        ]
        return OPERATION.with_tables(Spectrum.model_validate({"step": made}))

    several = {name: values for name, values in given.items() if name != "output_torque"}

    def capacity(run):
        return variants(GEARSET, run, RatingOptions(), ("iso14521",), **several)

    many = operation([(0.1 + 0.9 * n / 10000, 1.0 + n % 7) for n in range(10000)], slower=0.5)
    three = operation(loads)
    million = best(lambda: capacity(three))
    return {
        "million_of_three_s": million,
        "three_over_one": million / best(lambda: capacity(OPERATION)),
        "ten_thousand_s": best(lambda: rate(GEARSET, many)),
    }


def proposed(cut):
    """Propose gearsets as ``asperity size`` does."""
    return size(*ASKED, cut=cut)


def rated_alone(found):
    """Rate each proposal by a call of its own."""
    for proposal in found:
        gearset = Gearset(
            **proposal.keys, worm_material="case-hardened steel", wheel_material="CuSn12Ni2-C-GZ"
        )
        rate(gearset, OPERATION)


def main():
    """Run all and print one line a figure."""
    on_one_core()
    # Where module, diameter factor and profile shift are varied, the centre distance follows.
    given = columns(VARIANTS)
    seconds = best(lambda: rated(given))
    loop = best(lambda: one_by_one(given, SINGLE)) / SINGLE * VARIANTS
    slow = best(lambda: plainly(given, PLAIN)) / PLAIN * VARIANTS
    some = {name: values[:5000] for name, values in given.items()}
    five = {name: values[:5] for name, values in given.items()}
    # What is shown is cut besides; the kernels are there after the first.
    found = proposed(cut=True)
    thousand = 1000.0 / found.rated
    sized = best(lambda: proposed(cut=True)) * thousand
    alone = best(lambda: rated_alone(found.found)) * 1000.0 / len(found.found)
    report = {
        "efficiency": {
            "million_s": seconds,
            "of_the_target": seconds / TARGET_S,
            "loop_over_arrays": loop / seconds,
            "plain_over_arrays": slow / seconds,
        },
        "studies": {
            "five_ms": 1e3 * best(lambda: rated(five, capacity=True)),
            "five_thousand_ms": 1e3 * best(lambda: rated(some, capacity=True)),
        },
        "proposals": {
            "rated": found.rated,
            "shown": len(found.found),
            "thousand_s": sized,
            "uncut_thousand_s": best(lambda: proposed(cut=False)) * thousand,
            "one_by_one_over_proposals": alone / sized,
        },
        "spectrum": spectra(given),
        "agreement": {},
    }
    together = rated(given)[TOTAL]
    for name, way in (("loop", one_by_one(given, SINGLE)), ("plain", plainly(given, PLAIN))):
        arrays = together[: way.size]
        if not np.array_equal(np.isnan(arrays), np.isnan(way)):
            raise RuntimeError("masked gearsets are not those that have no answer")
        report["agreement"][f"{name}_difference"] = float(np.nanmax(np.abs(way / arrays - 1.0)))
    finish(
        report,
        most={
            "of_the_target": 1.0,
            "thousand_s": PROPOSALS_S,
            "three_over_one": 2.4,
        },
        held={"million_of_three_s": MILLION_OF_THREE_S, "ten_thousand_s": TEN_THOUSAND_S},
        least={"one_by_one_over_proposals": ONE_BY_ONE_OVER_PROPOSALS},
    )


if __name__ == "__main__":
    main()
