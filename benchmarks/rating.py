"""How fast variants of a worm gearset are rated, against other ways in the same run.

Run it with ``make bench``. Every line gives a time and a ratio: on a shared machine only the ratio
means something. All runs are on one core. The other ways: a loop of the package's single calls,
and the formulas written down plainly for floats, unchecked.
"""

import math

import numpy as np
from _common import best, finish, on_one_core

from asperity.gearset.materials import wheel_material
from asperity.rating import iso14521

VARIANTS = 1_000_000
SINGLE = 300
PLAIN = 20_000
TARGET_S = 2.0

MATERIALS = ("CuSn12-C-GZ", "CuSn12Ni2-C-GZ", "CuAl10Fe5Ni5-C-GZ", "EN-GJS-400-15")
OILS = ("mineral", "polyalphaolefin", "polyglycol")


def variants(count, several=False):
    """Gearsets of one and four starts with everything varied at once."""
    rng = np.random.default_rng(14521)
    columns = {
        "starts": rng.choice([1.0, 2.0, 4.0], count),
        "wheel_teeth": rng.integers(30, 81, count).astype(float),
        "diameter_factor": rng.uniform(6.0, 14.0, count),
        "axial_module": rng.uniform(1.0, 10.0, count),
        "profile_shift": rng.uniform(-0.5, 0.5, count),
        "pressure_angle": np.radians(rng.uniform(14.5, 30.0, count)),
        "worm_speed": rng.uniform(100.0, 3000.0, count),
        "worm_roughness": rng.uniform(0.4, 3.2, count),
        "output_torque": rng.uniform(10.0, 1000.0, count),
        "material": "CuAl10Fe5Ni5-C-GZ",
        "base_oil": "mineral",
    }
    if several:
        columns["material"] = np.array(MATERIALS)[rng.integers(0, len(MATERIALS), count)]
        columns["base_oil"] = np.array(OILS)[rng.integers(0, len(OILS), count)]
    return columns


def plain(row, law, material_factor):
    """The same chain as one writes it first, with nothing checked."""
    z1, z2, q, m = (row[k] for k in ("starts", "wheel_teeth", "diameter_factor", "axial_module"))
    n_1, torque, x_2 = row["worm_speed"], row["output_torque"], row["profile_shift"]
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
    mu *= math.sqrt(100.0 / a) * math.sqrt(0.07 / h) * (row["worm_roughness"] / 0.5) ** 0.25
    eta = math.tan(lead) / math.tan(lead + math.atan(mu))
    power = 2.0 * math.pi / 60.0 * torque * n_1 / u
    lost = 0.1 * torque * n_1 / u * (1.0 / eta - 1.0) + 0.89e-4 * a * n_1 ** (4.0 / 3.0)
    lost += 0.013 * power * a**0.44 * u / d_m2 + 2.0 * 11.78e-6 * d_m1 * d_m1 * n_1
    return power / (power + lost)


def plainly(columns, count):
    """Rate the first gearsets in a loop of plain formulas."""
    law = iso14521.friction_constants("aluminium bronze", "bath", "mineral")
    factor = wheel_material(MATERIALS[2]).material_factor
    names = [name for name, values in columns.items() if not isinstance(values, str)]
    rows = zip(*(columns[name][:count].tolist() for name in names), strict=True)
    return np.array([plain(dict(zip(names, row, strict=True)), law, factor) for row in rows])


def one_by_one(columns, count):
    """Rate the first gearsets in a loop of single calls."""
    answers = []
    for i in range(count):
        row = {name: v if isinstance(v, str) else v[i].item() for name, v in columns.items()}
        try:
            answers.append(iso14521.chain(**row).total_efficiency)
        except iso14521.FilmParameterError:
            answers.append(np.nan)
    return np.array(answers)


def efficiency_chain(report):
    """A million gearsets from the geometry to the efficiency of the gearbox."""
    for name, several in (("one material", False), ("12 pairings", True)):
        columns = variants(VARIANTS, several)
        for mode in ("raise", "mask"):
            seconds = best(lambda c=columns, m=mode: iso14521.chain(**c, on_invalid=m))
            loop = best(lambda c=columns: one_by_one(c, SINGLE)) / SINGLE * VARIANTS
            report[f"{name}, {mode}"] = {
                "million_s": seconds,
                "of_the_target": seconds / TARGET_S,
                "loop_million_s": loop,
                "loop_over_arrays": loop / seconds,
            }


def other_ways(report):
    """The plain loop, and the largest difference of each way from the arrays."""
    columns = variants(VARIANTS)
    seconds = best(lambda: plainly(columns, PLAIN)) / PLAIN * VARIANTS
    report["plain formulas"] = {
        "million_s": seconds,
        "plain_over_arrays": seconds / report["one material, mask"]["million_s"],
    }
    together = iso14521.chain(**columns, on_invalid="mask").total_efficiency
    report["agreement"] = {}
    for name, way in (("loop", one_by_one(columns, SINGLE)), ("plain", plainly(columns, PLAIN))):
        arrays = together[: way.size]
        if not np.array_equal(np.isnan(arrays), np.isnan(way)):
            raise RuntimeError("masked gearsets are not those that have no answer")
        report["agreement"][f"{name}_difference"] = float(np.nanmax(np.abs(way / arrays - 1.0)))


def main():
    """Run all and print one line a figure."""
    on_one_core()
    report = {}
    efficiency_chain(report)
    other_ways(report)
    finish(report, most={"of_the_target": 1.0})


if __name__ == "__main__":
    main()
