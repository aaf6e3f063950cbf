import pytest

from asperity.block.parameters import Block, Contact
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError

STEEL = {"size": (0.04, 0.03, 0.03), "youngs_modulus": 209e9, "poissons_ratio": 0.3}


def test_a_block_needs_size_and_material_and_has_defaults_for_the_rest():
    block = Block(**STEEL, units="SI")
    assert (block.elements, block.element, block.modes) == ((8, 6, 6), "hex27", 0)
    contact = Contact()
    assert (contact.normal, contact.stiffness) == ("linear", None)


def test_size_and_mass_make_contact_area_and_density():
    block = Block(**STEEL, units="SI")
    assert block.area == pytest.approx(1.2e-3)
    assert block.density(0.5) == pytest.approx(0.5 / (0.04 * 0.03 * 0.03))


def test_only_27_node_elements_are_of_second_order():
    orders = {
        name: Block(**STEEL, element=name, units="SI").order for name in ("hex27", "hex8", "hex8i")
    }
    assert orders == {"hex27": 2, "hex8": 1, "hex8i": 1}


def test_auto_is_ten_times_the_stiffness_of_the_elements_in_contact():
    assert Contact().normal_stiffness(209e9, 5e-3) == pytest.approx(10 * 209e9 / 5e-3)
    auto = Contact.model_validate({"stiffness": "auto"})
    assert auto == Contact()


def test_a_given_stiffness_is_taken_in_its_unit():
    contact = Contact.model_validate({"stiffness": "2 MPa/um"}, context={"text_only": True})
    assert contact.normal_stiffness(209e9, 5e-3) == pytest.approx(2e12)


@pytest.mark.parametrize(("modulus", "height"), [(0.0, 1e-3), (209e9, 0.0)])
def test_auto_refuses_a_body_without_stiffness_or_height(modulus, height):
    with pytest.raises(InputError, match="both must be positive"):
        Contact().normal_stiffness(modulus, height)


@pytest.mark.parametrize(
    ("setting", "why"),
    [
        ('block.size=["40 mm","30 mm"]', "it must be a list of three"),
        ('block.size="40 mm"', "it must be a list of three"),
        (
            "block.size=[40,30,30]",
            "block.size is 40, number 1 of the list; it must be a length such as '40 mm'",
        ),
        ('block.size=["40 mm","30 mm","-1 mm"]', "it must be at least 0.001 mm and at most 1e+06"),
        ('block.size=["40 mm","30 mm","0 mm"]', "it must be at least 0.001 mm and at most 1e+06"),
        ('block.size=["40 mm","30 mm","10 um"]', "elements of 0.005 x 0.005 x 1.667e-06 m"),
        ("block.youngs_modulus=0 GPa", "it must be above 0 GPa and at most 100000 GPa"),
        ("block.youngs_modulus=1e30 Pa", "it must be above 0 GPa and at most 100000 GPa"),
        ("block.poissons_ratio=0.5", "it must be at least 0 and below 0.5"),
        ("block.elements=[8,6,0]", "greater than or equal to 1"),
        ("block.elements=[8,6,1001]", "less than or equal to 1000"),
        ("block.elements=[8,6,6.5]", "valid integer"),
        ("block.element=hex20", "'hex27', 'hex8', 'hex8i' (did you mean 'hex27'?)"),
        ("block.modes=-1", "greater than or equal to 0"),
        ("block.depth=1 mm", "block.depth is not a key of [block]"),
        ("contact.normal=soft", "'linear', 'two-stage', 'hard'"),
        ("contact.stiffness=stiff", "'auto' or a pressure per length such as '40 GPa/um'"),
        ("contact.stiffness=0 Pa/m", "it must be above 0 GPa/um and at most 100000 GPa/um"),
        ("contact.stiffness=5 MPa", "'auto' or a pressure per length"),
        ("contact.stifness=auto", "did you mean 'stiffness'?"),
        ('contact.transition=["1 nm", "3 nm"]', "contact.normal is 'linear', which has no stages"),
        ('contact.transition="1 nm"', "it must be a list of two overclosures"),
        ('contact.transition=["-1 nm", "1 nm"]', "it must be at least 0 nm and at most"),
        ("contact.initial_stiffness=auto", "it must be a pressure per length such as '40 GPa/um'"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(setting, why):
    with pytest.raises(InputError) as caught:
        read_case("block-longitudinal", case_tables(), [setting])
    line = str(caught.value)
    assert why in line
    assert "\n" not in line


@pytest.mark.parametrize(
    ("settings", "why"),
    [
        (
            ["contact.normal=hard", "contact.initial_stiffness=1 GPa/um"],
            "contact.initial_stiffness is given, and contact.normal is 'hard', which has no stages",
        ),
        (
            ["contact.normal=two-stage", 'contact.transition=["3 nm", "1 nm"]'],
            "contact.transition is from 3e-09 to 1e-09 m; the second must be greater",
        ),
    ],
)
def test_stages_are_for_two_and_in_their_order(settings, why):
    with pytest.raises(InputError) as caught:
        read_case("block-longitudinal", case_tables(), settings)
    assert why in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("name", "table"), [("longitudinal", "4.3"), ("transverse", "4.4")])
def test_the_blocks_that_ship_are_the_sliding_bodies_with_a_block(name, table):
    block, body = (read_case(case, case_tables()) for case in (f"block-{name}", f"table-{table}"))
    assert set(block.tables) - set(body.tables) == {"block", "contact"}
    for key, value in body.tables.items():
        # What stays where the pressure changes does not matter to a body whose load is a constant.
        keeps = {"keeps": "deflection"} if key == "friction" else {}
        assert block[key] == value.model_copy(update=keeps, units="SI")
    assert block[Block.table] == Block(**STEEL, units="SI")
    assert block[Contact.table] == Contact()
