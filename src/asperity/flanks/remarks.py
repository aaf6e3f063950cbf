"""What a reader of a study of flanks should know: what was assumed, and what is from memory."""

from asperity.flanks import parameters
from asperity.flanks.meshing import lubrication
from asperity.flanks.parameters import Disc, Hob
from asperity.gearset import Gearset
from asperity.gearset.proportions import SOURCES as PROPORTIONS
from asperity.sources import Source

_CUSTOMARY = {
    "disc.diameter": f"{1e3 * parameters.DISC_DIAMETER:g} mm",
    "disc.profile_radius": f"{parameters.DISC_PROFILE_RADIUS:g} modules",
    "hob.tip_radius": f"{parameters.HOB_TIP_RADIUS:g} modules, or what there is room for",
}
_OUTSIDE = Source("common practice", "from memory", "d_a2 + m")


def assumptions(gearset: Gearset, hob: Hob | None, disc: Disc | None) -> dict[str, str]:
    """Return the keys that bear on the flanks and were left out, and what was assumed for them."""
    found = {
        f"gearset.{key}": text
        for key, text in gearset.assumed.items()
        if key not in ("worm_roughness",)
    }
    if hob is None:
        found["hob"] = "identical to the worm"
    elif "oversize" not in hob.model_fields_set:
        found["hob.oversize"] = "1, the worm's own size"
    if hob is None or hob.tip_radius is None:
        found["hob.tip_radius"] = _CUSTOMARY["hob.tip_radius"]
    for key in _ground(gearset):
        name = key.partition(".")[2]
        if disc is None or name not in disc.model_fields_set:
            found[key] = _CUSTOMARY[key]
    return found


def from_memory(
    gearset: Gearset, assumed: dict[str, str], *, loaded: bool = False
) -> dict[str, str]:
    """Return what rests on something that no document at hand confirms, with its source."""
    sources = {
        f"gearset.tooth_proportions {gearset.tooth_proportions}": PROPORTIONS[
            gearset.tooth_proportions
        ],
        "outside diameter of the wheel": _OUTSIDE,
        **{key: parameters.SOURCES[key] for key in assumed if key in parameters.SOURCES},
        **(lubrication.SOURCES if loaded else {}),
    }
    return {
        key: source.name + (f"; {source.note}" if source.note else "")
        for key, source in sources.items()
        if source.confidence == "from memory"
    }


def _ground(gearset: Gearset) -> tuple[str, ...]:
    return {"ZK": ("disc.diameter",), "ZC": ("disc.diameter", "disc.profile_radius")}.get(
        gearset.flank, ()
    )
