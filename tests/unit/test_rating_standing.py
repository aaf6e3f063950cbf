"""What standards come to: short on the terminal, whole in the report."""

from asperity.rating.standing import WIDTH, Standing

WHY = (
    "h* is -0.00541; it must be above 0. m_x1 = 0.9891 mm drives it (with x_2 = -2.48e-06); any "
    "one of these, x_2 following, brings it back: m_x1 of 1.2 mm, z_2 of 80"
)
NONE = [Standing("iso14521", "no answer", reasons=(WHY,))]


def test_a_long_reason_ends_where_a_part_of_it_ends():
    _, told = Standing.sentences(NONE)
    assert told.endswith("(with x_2 = -2.48e-06) ...")
    assert len(told) <= 2 * WIDTH


def test_a_reason_that_fits_and_one_without_parts_stay_as_they_were():
    short = [Standing("bs721", "no answer", reasons=("the table goes no further",))]
    assert [*Standing.sentences(short)][1] == "BS 721: the table goes no further"
    endless = [Standing("bs721", "no answer", reasons=("on " * 80,))]
    assert [*Standing.sentences(endless)][1].endswith("on on ...")


def test_the_report_has_the_whole_reason():
    _, told = Standing.sentences(NONE, whole=True)
    assert told == f"ISO/TR 14521: {WHY}"
