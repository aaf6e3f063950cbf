"""The drawing as DXF is sound, measures what the geometry has, and bears the drawing's data."""

import math
import sys

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import MissingExtraError
from asperity.flanks.export.cad.dxf import NAME, write_dxf
from asperity.flanks.export.turned import Bodies
from asperity.flanks.measuring.drawing import Datum, drawing_data, on_drawing
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.backlash import backlash
from asperity.gearset.tolerancing.grades import graded
from asperity.gearset.tolerancing.table import Tolerances
from asperity.results.language import catalogue_of, spoken

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


@pytest.mark.slow
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


class Measured:
    """Whatever is measured is some number."""

    def __getattr__(self, name):
        return 1.25


@pytest.fixture(scope="module")
def with_shaft():
    case = read_case("actuator-shafts", case_tables(), ["tolerances.centre_distance=js7"])
    pair = Pair.of(case.require(Gearset))
    play = backlash(case.require(Gearset), case.require(Tolerances))
    data = drawing_data(pair, Measured(), graded(pair.geometry, 8), play)
    return pair, data, Bodies.of(case, pair)


@pytest.mark.slow
def test_a_drawing_in_german_leaves_nothing_english(with_shaft, tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    german = catalogue_of("de")
    german.missing.clear()
    pair, data, bodies = with_shaft
    with spoken(german):
        write_dxf(tmp_path, pair, data, beside=bodies, name="ours")
    assert german.missing == set()
    document = ezdxf.readfile(tmp_path / NAME)
    texts = {text.dxf.text for text in document.modelspace().query("TEXT")}
    assert {"Schneckenrad", "Radsatz", "Zahnbreite", "Wälzfräser: Neigung"} <= texts
    assert not {one.name for one in data} & texts
    write_dxf(tmp_path, pair, data, beside=bodies, name="ours")
    texts = {t.dxf.text for t in ezdxf.readfile(tmp_path / NAME).modelspace().query("TEXT")}
    assert {one.name for one in data} <= texts


@pytest.mark.slow
def test_the_data_have_the_threads_that_the_shaft_has(with_shaft, tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    pair, data, bodies = with_shaft
    for beside, long in ((bodies, 90.0), (None, pair.geometry.worm_face_width)):
        write_dxf(tmp_path, pair, data, beside=beside)
        texts = [t.dxf.text for t in ezdxf.readfile(tmp_path / NAME).modelspace().query("TEXT")]
        place = texts.index("b_1")
        assert texts[place - 1 : place + 2] == [
            "length of the threaded worm", "b_1", f"{long:.3f}"
        ]  # fmt: skip


@pytest.mark.slow
def test_shafts_have_the_dimensions_of_their_sections(with_shaft, tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    pair, data, bodies = with_shaft
    write_dxf(tmp_path, pair, data, beside=bodies)
    space = ezdxf.readfile(tmp_path / NAME).modelspace()
    measured = [round(float(one.get_measurement()), 6) for one in space.query("DIMENSION")]
    for sizes in ((20, 40, 40, 190), (25, 30, 30), (50, 35, 50, 35, 170), (45, 50, 55, 50)):
        for size in sizes:
            assert measured.count(size) >= sizes.count(size), size
    write_dxf(tmp_path, pair, data)
    space = ezdxf.readfile(tmp_path / NAME).modelspace()
    plain = [round(float(one.get_measurement()), 6) for one in space.query("DIMENSION")]
    assert len(measured) - len(plain) == 3 + 3 + 1 + 4 + 4 + 1


def test_what_rounding_left_has_no_sign():
    assert on_drawing(Datum("both", "backlash", "j", -1e-12, "mm")) == "0.000"
    assert on_drawing(Datum("both", "backlash", "j", -6e-4, "mm")) == "-0.001"
    assert on_drawing(Datum("both", "backlash", "j", -4e-5, "in")) == "0.0000"


def test_without_the_extra_a_line_says_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    pair = Pair.of(read_case("gearset-2", case_tables()).require(Gearset))
    with pytest.raises(MissingExtraError, match=r"pip install asperity\[draw\]"):
        write_dxf(tmp_path, pair, DATA)
