"""``asperity rig package`` and ``rig report --standard``: what a repository and an auditor ask for.

The rules are those of DataCite's schema for kernel 4 (4.3, JSON) and of the RO-Crate 1.1
specification, root data entity and data entities.
"""

import datetime
import hashlib
import json
import re
import shutil
import urllib.parse
import zipfile
from pathlib import Path

import h5py
import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError, StorageError
from asperity.tribometer.deposit import Package, Person
from asperity.tribometer.package import result as packaged
from asperity.tribometer.recording import Recorder, Recording, Source, layout
from asperity.tribometer.report.standards import measured

RECORDING = Path(__file__).parents[1] / "answers" / "rig.nc"
CASE = """
[package]
title = "Friction of steel on bronze under vibration"
authors = ["Doe, Jane; 0000-0002-1825-0097; University of Somewhere", "Roe, Richard"]
licence = "CC-BY-4.0"
keywords = ["friction", "vibration"]
related = ["10.1000/xyz"]
funding = ["A Funder; 42"]
instruments = ["PicoScope 4824A; GQ123/045; oscilloscope"]

[conditions]
laboratory = "Laboratory 1"
temperature = "22 degC"
humidity = "45 %"
"""
SENSOR = (
    'channels.torque_steel={channel="A", points=[["-5 V","-2 N m"],["0 V","0 N m"],["5 V","2 N m"]]'
    ', points_down=[["0.01 V","0 N m"]], uncertainty="2 mN m", capacity="2 N m", '
    'accuracy_class=0.1, sensor="Kistler 4502A002H", serial="8421", certificate="K-77", '
    "date=2025-06-01, due=2026-06-01}"
)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A folder with a recording and a journal, and a case beside it."""
    folder = tmp_path_factory.mktemp("package")
    (folder / "run").mkdir()
    shutil.copy(RECORDING, folder / "run" / "run 1.nc")
    with h5py.File(folder / "run" / "run 1.nc", "r+") as file:
        told = {"motor supply": "THURLBY THANDAR,PL303QMD-P,123456,1.04"}
        file.attrs["instruments"] = json.dumps(told)
    journal = {"line": 1, "kind": "begun"}
    (folder / "run" / "journal.jsonl").write_text(json.dumps(journal) + "\n")
    (folder / "case.toml").write_text(CASE)
    return folder


@pytest.fixture(scope="module")
def package(asperity, run):
    """What is written of it."""
    out = run / "out"
    given = "--config", run / "case.toml", "--standard", "G99", "--set", SENSOR
    code, printed, errors = asperity("rig", "package", run / "run", *given, "--out", out, "--json")
    assert code == 0, errors
    assert json.loads(printed)["licence"] == "CC-BY-4.0"
    return out


def _json(path):
    return json.loads(path.read_text("utf-8"))


def _strings(value):
    assert isinstance(value, str)
    assert value.strip() == value != ""


def check_datacite(told):
    """Hold metadata to what the schema requires and allows."""
    required = {"identifiers", "creators", "titles", "publisher", "publicationYear", "types",
                "schemaVersion"}  # fmt: skip
    allowed = required | {
        "subjects", "contributors", "dates", "language", "alternateIdentifiers",
        "relatedIdentifiers", "sizes", "formats", "version", "rightsList", "descriptions",
        "geoLocations", "fundingReferences", "container",
    }  # fmt: skip
    assert required <= told.keys() <= allowed
    assert told["schemaVersion"] == "http://datacite.org/schema/kernel-4"
    assert re.fullmatch(r"\d{4}", told["publicationYear"])
    _strings(told["publisher"])
    assert told["types"].keys() == {"resourceType", "resourceTypeGeneral"}
    assert told["types"]["resourceTypeGeneral"] in ("Dataset", "Collection", "Other")
    needs = {
        "identifiers": ("identifier", "identifierType"), "creators": ("name",),
        "titles": ("title",), "subjects": ("subject",), "dates": ("date", "dateType"),
        "relatedIdentifiers": ("relatedIdentifier", "relatedIdentifierType", "relationType"),
        "descriptions": ("description", "descriptionType"), "fundingReferences": ("funderName",),
        "rightsList": ("rightsUri",),
    }  # fmt: skip
    for key, names in needs.items():
        entries = told.get(key, [])
        assert len({json.dumps(one, sort_keys=True) for one in entries}) == len(entries)
        for one in entries:
            for name in names:
                _strings(one[name])
    for key in ("identifiers", "creators", "titles"):
        assert told[key]
    for one in told["creators"]:
        assert one.get("nameType", "Personal") in ("Personal", "Organizational")
        for identifier in one.get("nameIdentifiers", []):
            _strings(identifier["nameIdentifier"])
            _strings(identifier["nameIdentifierScheme"])
        for where in one.get("affiliation", []):
            _strings(where["name"])
    for one in told["dates"]:
        assert one["dateType"] in ("Collected", "Created", "Issued", "Available")
        for day in one["date"].split("/"):
            datetime.date.fromisoformat(day)
    assert {one["descriptionType"] for one in told["descriptions"]} <= {"Abstract", "Methods"}
    for key in ("sizes", "formats"):
        assert all(isinstance(one, str) for one in told[key])


def check_crate(told, folder):
    """Hold a crate to what the specification says it must have."""
    assert told.keys() == {"@context", "@graph"}
    assert told["@context"] == "https://w3id.org/ro/crate/1.1/context"
    graph = told["@graph"]
    entities = {one["@id"]: one for one in graph}
    assert len(entities) == len(graph)
    for one in graph:
        _strings(one["@id"])
        assert one["@type"]
        # Flattened: what is an entity stands by itself and is only referred to.
        for value in one.values():
            for part in value if isinstance(value, list) else [value]:
                if isinstance(part, dict):
                    assert part.keys() == {"@id"}
                    outside = part["@id"].startswith("https://w3id.org/ro/crate/")
                    assert outside or part["@id"] in entities, part
    descriptor = entities["ro-crate-metadata.json"]
    assert descriptor["@type"] == "CreativeWork"
    assert descriptor["conformsTo"] == {"@id": "https://w3id.org/ro/crate/1.1"}
    root = entities[descriptor["about"]["@id"]]
    assert root["@id"].endswith("/")
    assert root["@type"] == "Dataset"
    _strings(root["name"])
    _strings(root["description"])
    datetime.date.fromisoformat(root["datePublished"])
    licence = entities[root["license"]["@id"]]
    _strings(licence["name"])
    _strings(licence["description"])
    files = [one for one in graph if one["@type"] == "File"]
    assert {one["@id"] for one in files} == {one["@id"] for one in root["hasPart"]}
    for one in files:
        # A path is a relative URI: blanks and others are escaped.
        assert " " not in one["@id"]
        assert not one["@id"].startswith(("/", "."))
        content = (folder / urllib.parse.unquote(one["@id"])).read_bytes()
        assert one["contentSize"] == str(len(content))
        assert one["sha256"] == hashlib.sha256(content).hexdigest()
        assert re.fullmatch(r"[\w.+-]+/[\w.+-]+", one["encodingFormat"])
    for one in (one for one in graph if one["@type"] == "CreateAction"):
        for key in ("agent", "instrument", "result"):
            assert one[key]
        datetime.date.fromisoformat(one["endTime"])
    return entities


@pytest.mark.slow
def test_a_package_is_what_datacite_asks_for(package):
    told = _json(package / "datacite.json")
    check_datacite(told)
    assert told["creators"][0]["nameIdentifiers"][0]["nameIdentifier"].endswith(
        "0000-0002-1825-0097"
    )
    assert told["rightsList"][0]["rightsUri"] == "https://creativecommons.org/licenses/by/4.0/"
    assert told["publisher"] == ":unav"
    assert told["identifiers"][0]["identifierType"] == "URN"


@pytest.mark.slow
def test_a_package_is_an_ro_crate_with_its_instruments(package):
    entities = check_crate(_json(package / "ro-crate-metadata.json"), package)
    devices = [one for one in entities.values() if one["@type"] == "IndividualProduct"]
    assert {(one["name"], one.get("serialNumber")) for one in devices} >= {
        ("PicoScope 4824A", "GQ123/045"), ("Kistler 4502A002H", "8421"),
        ("THURLBY THANDAR PL303QMD-P", "123456"),
    }  # fmt: skip
    told = {one["name"]: one for one in _json(package / "instruments.json")}
    sheet = told["Kistler 4502A002H"]["calibration"]
    assert (sheet["certificate"], sheet["good_until"]) == ("K-77", "2026-06-01")
    assert sheet["hysteresis_percent"] == pytest.approx(0.2, rel=0.01)


def test_check_sums_are_those_of_every_file(run, package):
    rows = (package / "manifest-sha256.txt").read_text("utf-8").splitlines()
    told = dict(reversed(row.split("  ", 1)) for row in rows)
    there = {str(path.relative_to(package)) for path in package.rglob("*") if path.is_file()}
    assert told.keys() == there - {"manifest-sha256.txt"}
    for name, digest in told.items():
        assert hashlib.sha256((package / name).read_bytes()).hexdigest() == digest
    assert {"recordings/run 1.nc", "journal.jsonl", "case.toml", "results/budget.csv"} <= there
    kept = package / "recordings" / "run 1.nc"
    assert kept.read_bytes() == (run / "run" / "run 1.nc").read_bytes()


@pytest.mark.slow
def test_what_is_packed_can_be_reduced_again(asperity, package):
    # What was set stands in the case beside them.
    given = "--config", package / "case.toml", "--json"
    again = asperity("rig", "reduce", package / "recordings" / "run 1.nc", *given)[1]
    mine = json.loads(again)["segments"][0]["torque_change_percent"]
    kept = _json(package / "results" / "reduce.json")["segments"][0]["torque_change_percent"]
    assert kept == pytest.approx(mine, rel=1e-6)
    code, _, errors = asperity("check", package / "case.toml")
    assert code == 0, errors


@pytest.mark.slow
def test_an_archive_holds_the_same_files(asperity, run, package, tmp_path):
    given = "--config", run / "case.toml", "--archive", "--out", tmp_path / "out"
    code, _, errors = asperity("rig", "package", run / "run", *given)
    assert code == 0, errors
    assert [one.name for one in (tmp_path / "out").iterdir()] == ["package.zip"]
    there = {str(path.relative_to(package)) for path in package.rglob("*") if path.is_file()}
    with zipfile.ZipFile(tmp_path / "out" / "package.zip") as archive:
        assert archive.testzip() is None
        assert set(archive.namelist()) == there
        archive.extractall(tmp_path / "open")
    check_crate(_json(tmp_path / "open" / "ro-crate-metadata.json"), tmp_path / "open")


@pytest.mark.ordinary(4)
@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ((), ("package.title, package.authors and package.licence are missing", "CC-BY-4.0")),
        (("package.title=T", 'package.licence="CC0-1.0"'), ("package.authors is missing",)),
        (('package.authors=["Doe, J; 0000-0002-1825-0098"]',), ("no ORCID",)),
        (('package.licence="nonsense"',), ("package.licence", "SPDX", "CC0-1.0", "ODbL-1.0")),
        (('package.licence="cc-by-40"',), ("SPDX", "did you mean 'CC-BY-4.0'")),
        (('package.doi="doi:10.1/x"',), ("package.doi", "10.5281")),
    ],
)
def test_what_no_repository_takes_is_refused_in_a_line(asperity, run, tmp_path, settings, words):
    given = [part for one in settings for part in ("--set", one)]
    code, _, errors = asperity("rig", "package", run / "run", *given, "--out", tmp_path / "out")
    assert code == 2
    assert all(word in " ".join(errors.split()) for word in words), errors


@pytest.mark.slow
def test_a_case_that_is_begun_makes_a_package_when_its_examples_are_replaced(
    asperity, run, tmp_path
):
    begun = tmp_path / "my-rig.toml"
    assert asperity("new", "rig", begun)[0] == 0
    given = "rig", "package", run / "run", "--config", begun, "--out", tmp_path / "out"
    code, _, errors = asperity(*given)
    assert (code, (tmp_path / "out").exists()) == (2, False)
    told = " ".join(errors.split())
    assert "package.title and package.authors are what asperity new wrote for an example" in told
    assert "package.licence is missing" in told
    assert 'licence = "CC-BY-4.0"' in told
    text = begun.read_text("utf-8")
    mine = ("(title of these data)", "Mine"), ("Doe, Jane", "Roe, Richard")
    for word, own in (*mine, ('licence = ""', 'licence = "CC0-1.0"')):
        assert text.count(word) == 1
        text = text.replace(word, own)
    begun.write_text(text, "utf-8")
    code, _, errors = asperity(*given)
    assert code == 0, errors
    page = (tmp_path / "out" / "results" / "report.html").read_text("utf-8")
    assert "(your laboratory)" in page


@pytest.mark.slow
def test_a_package_that_a_full_disk_does_not_take_is_left_in_no_part(
    asperity, run, tmp_path, monkeypatch
):
    real, left = packaged.write_atomically, [6]

    def full(path, write):
        left[0] -= 1
        if left[0] < 0:
            raise StorageError(f"{path.name} cannot be written: no space left on device")
        return real(path, write)

    given = "rig", "package", run / "run", "--config", run / "case.toml", "--out", tmp_path / "out"
    with monkeypatch.context() as disk:
        disk.setattr(packaged, "write_atomically", full)
        code, _, errors = asperity(*given)
    assert code == 2
    assert "no space left" in errors
    assert list((tmp_path / "out").iterdir()) == []
    assert asperity(*given)[0] == 0


@pytest.mark.parametrize("name", ["datacite.json", "journal.jsonl"])
def test_a_package_goes_into_a_folder_of_its_own(asperity, run, tmp_path, name):
    (tmp_path / name).write_text("mine")
    given = "--config", run / "case.toml"
    code, _, errors = asperity("rig", "package", run / "run", *given, "--out", tmp_path)
    assert (code, [one.name for one in tmp_path.iterdir()]) == (2, [name])
    assert (tmp_path / name).read_text() == "mine"
    assert f"has {name} already" in " ".join(errors.split())
    code, _, errors = asperity("rig", "package", run / "run", *given)
    assert code == 2
    assert "--out" in errors


def test_an_author_is_read_with_orcid_and_affiliation():
    assert Person.read("Doe, Jane; 0000-0002-1825-0097; X; Y") == Person(
        "Doe", "Jane", "0000-0002-1825-0097", "X; Y"
    )
    assert Person.read("The Friction Group").name == "The Friction Group"
    # The tenth digit of ISO 7064 is an X.
    assert Person.read("Roe; https://orcid.org/0000-0002-1694-233X").orcid.endswith("X")
    with pytest.raises(InputError, match="no name"):
        Package(authors=["; 0000-0002-1825-0097"])


def test_a_packed_report_has_the_headings_that_were_asked_for(package):
    page = (package / "results" / "report.html").read_text("utf-8")
    for words in ("By the headings of ASTM G99", "Coefficient of friction", "Laboratory 1",
                  "not recorded", "Uncertainty (GUM)", "serial 8421", "Calibrations"):  # fmt: skip
        assert words in page


@pytest.mark.slow
@pytest.mark.parametrize("standard", ["G99", "G133"])
def test_a_report_has_what_a_standard_asks_for(asperity, run, tmp_path, standard):
    given = "--standard", standard, "--config", run / "case.toml", "--out", tmp_path, "--json"
    code, printed, errors = asperity("rig", "report", run / "run", *given)
    assert code == 0, errors
    asked = json.loads(printed)["asked"]
    flat = {name: told for items in asked.values() for name, told in items.items()}
    assert flat["normal force"] == "141.6 N"
    assert flat["temperature of the air"] == "22 degC"
    assert flat["relative humidity"] == "45 %"
    assert flat["laboratory"] == "Laboratory 1"
    # Nobody told these, and so they stand as such.
    untold = (
        "operator", "cleaning", "atmosphere", "steel disc: treatment", "bronze disc: mass loss",
        "steel disc: volume loss", "temperature, measured",
    )  # fmt: skip
    for name in untold:
        assert flat[name] == "not recorded"
    assert ("frequency" in flat) == (standard == "G133")
    if standard == "G133":
        # 20 mm/s at 250 Hz, by the table of the case: 12.7 um to either side.
        stroke = float(flat["stroke (twice the amplitude)"].split()[0])
        assert stroke == pytest.approx(2.0 * 20e3 / (2.0 * 3.14159 * 250.0), rel=1e-3)
    page = (tmp_path / "report.html").read_text("utf-8")
    assert f"By the headings of ASTM {standard}" in page
    assert all(heading in page for heading in asked)
    assert "not recorded" in page
    assert "Coefficient of friction" in page


def test_what_a_channel_measured_is_told_in_its_unit(tmp_path):
    line = 'channels.temperature={channel="T", points=[["0 V","0 degC"],["1 V","100 degC"]]}'
    case = read_case("rig-final", case_tables(), [line])
    with Recorder(tmp_path / "run.nc", [Source("temperature", "V", 1e-3)], 1e-2) as recorder:
        recorder.append(np.array([[240], [250], [layout.MISSING]], np.int16), 0.03)
    recordings = [Recording.open(tmp_path / "run.nc")]
    assert measured("temperature", case, recordings) == "24.5 degC"
    assert measured("normal_force", case, recordings) == "not recorded"


def test_a_report_follows_no_other_standard(asperity, run):
    code, _, errors = asperity("rig", "report", run / "run", "--standard", "G98")
    assert code == 2
    assert "'G99'" in errors


def test_a_sensor_that_breaks_its_class_is_told(asperity, run):
    code, printed, errors = asperity(
        "rig", "reduce", run / "run" / "run 1.nc", "--set", SENSOR, "--json"
    )
    assert code == 0, errors
    # A loop of 4 mN m of 2 N m, which is twice its class.
    told = [note for note in json.loads(printed)["notes"] if "class" in note]
    assert len(told) == 1
    assert "torque_steel is of class 0.1" in told[0]
