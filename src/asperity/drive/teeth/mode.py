"""How high a tooth's own vibration is, from which on it is no longer quasi-static."""

import numpy as np

from asperity.contact.elastic import ElasticMaterial, elastic_body
from asperity.contact.elastic.modes import natural_modes
from asperity.drive.teeth.sector import DENSITY, ELEMENT, RIM, own_mesh
from asperity.flanks.mesh.tooth import contact_counts
from asperity.flanks.wheel.enveloped import Wheel
from asperity.gearset.materials import WheelMaterial
from asperity.runs.cache import Cache
from asperity.runs.key import code_key, key


def lowest_mode(wheel: Wheel, material: WheelMaterial) -> float:
    """Return the lowest natural frequency of a tooth that is cut out with its rim, Hz.

    The inside of the rim is held, its cut faces are free: a tooth of a whole wheel, whose rim goes
    on, is stiffer. The coarse mesh serves, and what was found is kept.

    Parameters
    ----------
    wheel : Wheel
        The cut wheel.
    material : WheelMaterial
        What it is made of.
    """
    mesh = own_mesh(wheel, contact_counts("coarse")).converted("m")
    elastic = ElasticMaterial(material.youngs_modulus, material.poisson_ratio, DENSITY)
    kept = Cache.of_this_user("modes")
    digest = key(code_key(__name__), mesh.points, mesh.cells, repr(elastic))
    known = kept.get(digest)
    if known is not None:
        return float(known["frequency"][0])
    body = elastic_body(mesh, elastic, element=ELEMENT, tied=RIM)
    _, frequency = natural_modes(body, 1)
    kept.put(digest, {"frequency": np.asarray(frequency)})
    return float(frequency[0])
