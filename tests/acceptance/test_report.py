"""The report of ``--out``: its numbers, what a user wrote in it, and that it stands alone."""

import functools
import html.parser
import json
import math
import operator

import pytest


class Page(html.parser.HTMLParser):
    """What is checked of a page: its numbers with their keys, its tags, and what they ask for."""

    def __init__(self, text):
        super().__init__()
        self.numbers, self.tags, self.asked = [], [], []
        self._open = None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.tags.append(tag)
        self.asked += [found[key] for key in ("src", "href") if key in found]
        if tag == "data" or "data-value" in found:
            value = found.get("value", found.get("data-value"))
            self._open = [float(value), found.get("data-key"), ""]

    def handle_data(self, data):
        if self._open is not None:
            self._open[2] += data

    def handle_endtag(self, tag):
        if tag in ("data", "tspan") and self._open is not None:
            self.numbers.append(tuple(self._open))
            self._open = None


EVIL = "<script>alert(1)</script>"
NOT_CSS = 'Gears "& Co" </style>'


@pytest.fixture(scope="module")
def rated(tmp_path_factory):
    from asperity.cli.main import main

    folder = tmp_path_factory.mktemp("report")
    project = (f"name={EVIL}", f"customer={NOT_CSS}", "author=me")
    settings = [part for entry in project for part in ("--set", f"project.{entry}")]
    with pytest.raises(SystemExit) as ended:
        main(["rate", "gearset-3", *settings, "--out", str(folder)])
    assert not ended.value.code
    text = (folder / "report.html").read_text("utf-8")
    return text, Page(text), json.loads((folder / "rate.json").read_text("utf-8"))


def test_every_number_of_a_report_is_that_of_the_json_and_shown_rounded(rated):
    _, page, answer = rated
    assert len(page.numbers) > 200
    for value, key, shown in page.numbers:
        path = (int(part) if part.isdigit() else part for part in key.split("."))
        assert functools.reduce(operator.getitem, path, answer) == value, key
        assert float(shown) == pytest.approx(value, rel=6e-5), key


def test_a_report_asks_for_nothing(rated):
    _, page, _ = rated
    assert all(place.startswith("data:") for place in page.asked)
    assert not {"script", "iframe", "object", "form"} & set(page.tags)


def test_what_a_user_wrote_of_the_project_is_text_in_the_report(rated):
    text, page, _ = rated
    assert EVIL not in text
    assert "&lt;script&gt;" in text
    assert text.count("</style>") == 1
    assert page.tags.count("style") == 1


def test_a_report_has_each_section(rated):
    text, _, _ = rated
    for title in ("Verdict", "The gearset", "Power", "Forces on shafts and bearings",
                  "Self-locking", "Assumed", "Calculation by ISO/TR 14521:2010", "Sources",
                  "The case file"):  # fmt: skip
        assert f"<h2>{title}" in text


@pytest.mark.parametrize("hand", ["right", "left"])
def test_forces_balance_on_the_worm_and_do_its_work(rated, hand):
    import asperity

    found = asperity.rate("gearset-3", settings=[f"gearset.hand={hand}"])
    arm = 0.5 * found.geometry.worm_pitch_diameter
    half = 0.5 * float(found.given.bearing_span)
    for forces, turn in zip(found.forces, (-1.0, 1.0), strict=True):
        x, y, z = forces.worm
        (ay, az), (by, bz) = forces.driven_end, forces.free_end
        assert (ay + by, az + bz) == pytest.approx((y, z))
        assert half * (ay - by) == pytest.approx(arm * x)
        # A worm that drives is held back; the wheel moves the way it is pushed.
        assert -arm * z * turn < 0.0
        advance = -turn * (1.0 if hand == "right" else -1.0)
        assert forces.wheel[0] * advance > 0.0
        lost = arm * abs(z) - abs(x) * found.geometry.reduced_lead
        efficiency = abs(x) * found.geometry.reduced_lead / (arm * abs(z))
        assert lost > 0.0
        assert efficiency == pytest.approx(found.iso14521["eta_z1_2"])
    clockwise, other = found.forces
    assert clockwise.worm[0] == -other.worm[0]
    assert (clockwise.worm[0] < 0.0) == (hand == "right")


def test_a_project_changes_no_answer_that_is_kept():
    import asperity

    case = asperity.read("gearset-3")
    assert case.replace(["project.name=other"]).canonical() == case.canonical()


def test_the_drawing_is_to_scale(rated):
    import asperity
    from asperity.gearset.drawing import scale_of
    from asperity.results.svg import SCALES

    scale = scale_of(asperity.rate("gearset-3").geometry)
    assert scale in SCALES
    assert math.isfinite(scale)
