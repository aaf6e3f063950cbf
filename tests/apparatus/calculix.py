"""Bodies of 27-node hexahedra solved by CalculiX as 20-node ones: displacements and stresses.

G. Dhondt, K. Wittig: CalculiX, a free software three-dimensional structural finite element program.
"""

import re
import subprocess

import numpy as np

from asperity.mesh.inp import numbers
from asperity.mesh.shape import QUADRATIC_FACES


def solved(folder, points, cells, held, forces, material):
    """Return displacements, (N, 3), mm, and stresses xx, yy, zz, xy, yz, zx, (N, 6), MPa.

    Points in mm, forces, (N, 3), in N on nodes that 20-node hexahedra have. The middles of faces
    move as their edges say; what CalculiX has not is NaN.
    """
    used = np.unique(cells[:, :20])
    loaded = np.flatnonzero(forces.any(axis=1))
    assert np.isin(loaded, used).all()
    lines = [
        "*NODE", *(f"{n + 1}, {numbers(*points[n])}" for n in used),
        "*ELEMENT, TYPE=C3D20, ELSET=BODY",
        # Without the nodes in the middle of faces and cells.
        *(
            f"{k}, {', '.join(map(str, cell[:15] + 1))},\n{', '.join(map(str, cell[15:20] + 1))}"
            for k, cell in enumerate(cells, 1)
        ),
        "*MATERIAL, NAME=OWN", "*ELASTIC",
        numbers(1e-6 * material.youngs_modulus, material.poissons_ratio),
        "*SOLID SECTION, ELSET=BODY, MATERIAL=OWN", "*NSET, NSET=HELD",
        *(f"{node + 1}," for node in np.intersect1d(held, used)),
        "*BOUNDARY", "HELD, 1, 3", "*STEP", "*STATIC", "*CLOAD",
        *(
            f"{node + 1}, {axis + 1}, {numbers(forces[node, axis])}"
            for node in loaded for axis in range(3)
        ),
        "*NODE FILE", "U", "*EL FILE", "S", "*END STEP", "",
    ]  # fmt: skip
    (folder / "body.inp").write_text("\n".join(lines))
    done = subprocess.run(
        ["ccx", "body"], cwd=folder, capture_output=True, text=True, check=False, timeout=1200
    )
    assert "Job finished" in done.stdout, done.stdout[-2000:]
    text = (folder / "body.frd").read_text()
    moved, stress = (_field(text, name, len(points)) for name in ("DISP", "STRESS"))
    moved = moved[:, :3]
    faces = cells[:, QUADRATIC_FACES].reshape(-1, 9)
    around = moved[faces[:, :8]]
    moved[faces[:, 8]] = 0.5 * around[:, 4:].sum(axis=1) - 0.25 * around[:, :4].sum(axis=1)
    return moved, stress


def of_twenty_nodes(cells, forces):
    """Return forces, (N, 3), without those in the middle of faces: these move as their edges say.

    It is the same work on all that hexahedra of 20 nodes can do.
    """
    faces = np.unique(cells[:, QUADRATIC_FACES].reshape(-1, 9), axis=0)
    _, first = np.unique(faces[:, 8], return_index=True)
    faces = faces[first]
    out = forces.copy()
    middle = forces[faces[:, 8], None]
    np.add.at(out, faces[:, :4], -0.25 * middle)
    np.add.at(out, faces[:, 4:8], 0.5 * middle)
    out[faces[:, 8]] = 0.0
    return out


def _field(text, name, count):
    rows = re.search(rf"^ -4  {name}.*\n(?:^ -5.*\n)+((?:^ -1.*\n)+)", text, re.MULTILINE)[1]
    width = len(rows.splitlines()[0])
    found = np.full((count, (width - 13) // 12), np.nan)
    for row in rows.splitlines():
        found[int(row[3:13]) - 1] = [float(row[i : i + 12]) for i in range(13, width, 12)]
    return found
