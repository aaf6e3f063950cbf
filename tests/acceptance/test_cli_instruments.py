"""The descriptions of instruments that ship, on the command line."""

import json
import tomllib

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.tribometer.instruments.described import descriptions


def test_instruments_are_listed_and_printed(asperity):
    code, output, errors = asperity("instruments")
    assert (code, errors) == (0, "")
    for one in descriptions().values():
        line = next(line for line in output.splitlines() if line.startswith(f"{one.name} "))
        assert one.title in line
        assert line.endswith("off is read back")
    assert "none of them has been tried on a device" in output
    code, output, _ = asperity("instruments", "--json")
    listed = json.loads(output)["instruments"]
    assert {one["name"] for one in listed} == set(descriptions())
    assert all(one["source"] and one["off_is_read_back"] for one in listed)


def test_what_is_printed_is_a_table_of_a_case(asperity, tmp_path):
    for name, one in descriptions().items():
        code, output, _ = asperity("instruments", name)
        assert code == 0
        assert one.source in output
        table = "supplies" if one.kind == "supply" else "controller"
        assert tomllib.loads(output)[table] == dict(one.words)
        file = tmp_path / f"{name}.toml"
        more = 'port = "p"\n' + ('steel = "1"\n' if one.kind == "supply" else "")
        file.write_text(output + more)
        read_case(file, case_tables())


def test_an_instrument_that_does_not_ship_is_one_line(asperity):
    code, _, errors = asperity("instruments", "tti")
    assert code == 2
    assert errors == "tti is not an instrument that ships (did you mean 'tti-pl'?)\n"
