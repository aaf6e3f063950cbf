"""A study of flanks as one labelled dataset."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

    from asperity.flanks.result import FlankStudy


def flank_dataset(study: "FlankStudy") -> "xr.Dataset":
    """Return the maps and curves of both flanks, by ``side``, every variable with its unit.

    Velocities are those at the worm's speed of the attribute ``worm_speed_rad_per_s``.
    """
    import xarray as xr

    flanks = study.analysis.flanks
    parts = [flank.to_dataset().drop_attrs(deep=False) for flank in flanks.values()]
    whole = xr.concat(parts, "side", combine_attrs="override")
    side = xr.Variable("side", list(flanks), {"units": "1", "long_name": "flank s"})
    pair = study.analysis.pair
    return whole.assign_coords(side=side).assign_attrs(
        title=f"flanks of {study.name or 'a worm gearset'}",
        flank=pair.flank,
        hand=pair.hand,
        worm_speed_rad_per_s=flanks[1].motion.worm_speed,
        backlash_normal_mm=study.backlash,
        axial_clearance_mm=study.analysis.play.axial,
    )
