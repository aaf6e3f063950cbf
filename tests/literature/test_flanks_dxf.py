"""The drawing as DXF is sound, measures what the geometry has, and bears the drawing's data."""

import math
import sys

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import MissingExtraError
from asperity.flanks.export.cad.dxf import write_dxf
from asperity.flanks.measuring.drawing import Datum
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

DATA = [
    Datum("worm", "number of threads", "z_1", 4),
    Datum("wheel", "mean diameter", "d_m2", 131.8512345, "mm"),
    Datum("both", "deviation of the centre distance, to either side", "f_a", 0.015, "mm"),
]


@pytest.fixture(scope="module", params=["gearset-2", "gearset-3", "gearset-3b"])
def drawn(request, tmp_path_factory):
    ezdxf = pytest.importorskip("ezdxf")
    folder = tmp_path_factory.mktemp("drawing")
    pair = Pair.of(read_case(request.param, case_tables()).require(Gearset))
    name = write_dxf(folder, pair, DATA, deviation=0.015, name="ours")
    return pair.geometry, ezdxf.readfile(folder / name)


def test_it_is_sound_and_in_millimetres(drawn):
    _, document = drawn
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    assert document.header["$INSUNITS"] == 4


def test_dimensions_measure_the_geometry(drawn):
    g, document = drawn
    found = [one.get_measurement() for one in document.modelspace().query("DIMENSION")]
    for length in (
        g.centre_distance, g.wheel_mean_diameter, g.worm_face_width, g.wheel_throat_diameter,
        g.worm_tip_diameter, g.worm_root_diameter, g.wheel_outside_diameter, g.wheel_face_width,
    ):  # fmt: skip
        assert any(abs(one - length) < 1e-6 for one in found), length
    assert any("%%p0.015" in one.dxf.text for one in document.modelspace().query("DIMENSION"))


def test_circles_are_those_of_worm_and_wheel(drawn):
    g, document = drawn
    radii = [circle.dxf.radius for circle in document.modelspace().query("CIRCLE")]
    for diameter in (g.worm_tip_diameter, g.worm_root_diameter, g.wheel_mean_diameter):
        assert any(math.isclose(2.0 * radius, diameter) for radius in radii)


def test_it_bears_the_data(drawn):
    _, document = drawn
    texts = {text.dxf.text for text in document.modelspace().query("TEXT")}
    assert {"number of threads", "z_1", "131.851", "f_a", "0.015"} <= texts
    assert any(text.startswith("ours  1:") or text.startswith("ours  ") for text in texts)
    assert {"OUTLINE", "CENTRE", "HATCH", "DIMENSIONS", "TEXT"} <= {
        entity.dxf.layer for entity in document.modelspace()
    }


def test_without_the_extra_a_line_says_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    pair = Pair.of(read_case("gearset-2", case_tables()).require(Gearset))
    with pytest.raises(MissingExtraError, match=r"pip install asperity\[draw\]"):
        write_dxf(tmp_path, pair, DATA)
