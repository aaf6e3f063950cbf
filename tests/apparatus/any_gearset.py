"""Worm gearsets by lot, and case files of them."""

import json
import math
import random


def gearset(seed):
    """Settings of a random worm gearset, many of them at or beyond an end of a table."""
    rng = random.Random(seed)
    module, factor = rng.choice([0.8, 1, 1.6, 2.5, 4, 8, 16]), rng.uniform(6, 20)
    starts, teeth = rng.randint(1, 5), rng.randint(17, 110)
    size = module * (factor + teeth) / 2
    return {
        "gearset": {
            "starts": starts, "wheel_teeth": teeth, "axial_module": f"{module} mm",
            "diameter_factor": round(factor, 3),
            "worm_material": rng.choice(["case-hardened steel", "0.4C steel"]),
            "wheel_material": rng.choice(["CuSn12-C-GZ", "CuAl10Fe5Ni5-C-GZ", "EN-GJL-250"]),
        },
        "operation": {
            "worm_speed": f"{math.exp(rng.uniform(math.log(10), math.log(6000))):.4g} rpm",
            "output_torque": f"{(size / 100) ** 3 * math.exp(rng.uniform(2, 8)):.4g} N m",
            "lubricant": rng.choice(["ISO VG 220 mineral", "ISO VG 460 polyglycol"]),
            "fan": rng.random() < 0.5,
        },
    }  # fmt: skip


def written(tables):
    """Return settings as the text of a case file."""
    lines = []
    for table, keys in tables.items():
        lines.append(f"[{table}]")
        lines += [f"{key} = {json.dumps(value)}" for key, value in keys.items()]
    return "\n".join(lines)
