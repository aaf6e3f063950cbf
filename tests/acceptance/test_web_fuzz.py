"""A thousand requests that are wrong in every way that could be thought of.

Routes, bodies, settings and uploads of honest requests are changed at random, the same ones every
time. Whatever it is, it is answered or refused in one line, nothing fails, and nothing outside the
folder is read or written.
"""

import json
import random
from urllib.parse import quote

import pytest
from apparatus.page import Served

from asperity.commands import COMMANDS, case_tables

pytestmark = pytest.mark.slow

REQUESTS = 100  # of each part
PARTS = 10
SECRET = "not to be read by anybody"

HONEST = [
    ("GET", "/api/about", None), ("GET", "/api/forms", None), ("GET", "/api/case/table-4.3", None),
    ("GET", "/", None), ("GET", "/js/main.js", None), ("GET", "/api/jobs", None),
    ("GET", "/api/jobs/0123456789abcdef0123456789abcdef/answer", None),
    ("GET", "/api/jobs/0123456789abcdef0123456789abcdef/data?names=ratio", None),
    ("GET", "/api/jobs/0123456789abcdef0123456789abcdef/files/sweep.nc", None),
    ("GET", "/api/jobs/0123456789abcdef0123456789abcdef/files/flanks.bin", None),
    ("GET", "/api/thesis", None), ("GET", "/api/files/mine.csv", None),
    ("PUT", "/api/files/mine.csv", b"0,0\n1e-4,1\n2e-4,0\n"),
    ("PUT", "/api/files/mine.toml", b"[slider]\nmass = '1 kg'\n"),
    ("PUT", "/api/files/scope.csv?recorded", b"t,A\n(s),(V)\n\n0,0\n1e-4,1\n2e-4,0\n"),
    ("PUT", "/api/files/mine.csv?recorded&replace", b"t,A\n(s),(V)\n\n0,0\n1e-4,1\n"),
    ("PUT", "/api/files/rig.mat?recorded", b"MATLAB 5.0 MAT-file" + bytes(120)),
    ("PUT", "/api/files/rig.nc?recorded", b"\x89HDF\r\n\x1a\n" + bytes(200)),
    ("POST", "/api/save", {"name": "mine", "toml": "[slider]\n"}),
    ("POST", "/api/do/slide", {"case": "table-4.3", "settings": {"solve.method": "periodic"}}),
    ("POST", "/api/do/slide", {"case": "mine.toml", "settings": {}}),
    ("POST", "/api/do/rate", {"case": "gearset-3", "settings": {"gearset.starts": "2"}}),
    ("POST", "/api/do/curve", {"case": "table-4.3", "options": {"over": "k", "points": 5}}),
    ("POST", "/api/do/check", {"case": "rig-final", "settings": {}}),
    ("POST", "/api/do/methods", {"case": "gearset-3", "options": {"also": ["literature"]}}),
    ("POST", "/api/do/size", {"options": {"ratio": "40", "output_torque": "300 N m",
                                          "worm_speed": "1500 rpm", "rank": "size"}}),
    ("POST", "/api/jobs", {"command": "sweep", "case": "table-4.3",
                           "options": {"over": ["friction.mu=0.1,0.2"]}}),
    ("POST", "/api/jobs", {"command": "rig reduce", "arguments": {"recordings": ["a.nc"]}}),
    ("POST", "/api/jobs/0123456789abcdef0123456789abcdef/stop", {}),
    ("DELETE", "/api/jobs/0123456789abcdef0123456789abcdef", None),
]  # fmt: skip

KEYS = [f"{name}.{key}" for name, model in case_tables().items() for key in model.model_fields]
ODD = [
    "", "-1", "0", "nan", "inf", "1e308", "1e-308", "-0", "9" * 400, "[" * 50, "{}", "''", "\0",
    "\n", "a\u202eb", "\ud7ff", "💥" * 50, "1 mm", "1 parsec", "../x.toml", "/etc/passwd", "~",
    "C:\\x", "true", "[1, 2", "0.1 \n[slider]", "<script>alert(1)</script>", "%s%n", "$(touch x)",
    "x" * 5000, "None",
]  # fmt: skip
LINKS = ["link.toml", "link.csv"]
OUTSIDE = ["../outside.toml", "../outside.csv"]


@pytest.fixture(scope="module")
def shaken(new_user, tmp_path_factory):
    """A page of its own, beside files that are nobody's business."""
    place = tmp_path_factory.mktemp("shaken")
    (place / "outside.toml").write_text(f"# {SECRET}\n[slider]\n")
    (place / "outside.csv").write_text(f"{SECRET}\n")
    page = Served(place / "folder", new_user())
    (page.folder / "link.toml").symlink_to(place / "outside.toml")
    (page.folder / "link.csv").symlink_to(place / "outside.csv")
    yield page
    before = {"outside.toml", "outside.csv", "folder"}
    assert {path.name for path in place.iterdir()} == before
    assert all(SECRET in (place / name).read_text() for name in before - {"folder"})
    assert page.close() == ("", "")


@pytest.mark.campaign(over="part")
@pytest.mark.parametrize("part", range(PARTS))
def test_whatever_is_asked_is_answered_or_refused_in_one_line(shaken, part):
    chance = random.Random(part)
    for _ in range(REQUESTS):
        method, path, body = asked = mutated(chance)
        answer = shaken.ask(method, path, body)
        assert answer.status != 500, (asked, answer.body)
        assert answer.status in (200, 400, 403, 404, 405, 409, 413, 415, 422, 429), (asked, answer)
        assert b"Traceback" not in answer.body
        assert SECRET.encode() not in answer.body, asked
        if answer.status >= 400 and path.startswith("/api/") and answer.status != 405:
            assert "\n" not in answer.error, asked
            assert answer.json["exit_code"] in (1, 2, 3)
    assert shaken.get("/api/about").status == 200
    for job in shaken.get("/api/jobs").json:
        stop = f"/api/jobs/{job['id']}/stop"
        assert shaken.ask("POST", stop, {}).status == 200


def mutated(chance):
    """Return an honest request with one or a few things changed."""
    method, path, body = chance.choice(HONEST)
    body = json.loads(json.dumps(body)) if isinstance(body, dict) else body
    for _ in range(chance.randint(1, 3)):
        what = chance.choice(["path", "body", "body", "body", "method"])
        if what == "path":
            path = _other_path(chance, path)
        elif what == "method" and chance.random() < 0.3:
            method = chance.choice(["GET", "POST", "PUT", "DELETE", "HEAD"])
        elif isinstance(body, dict):
            _change(chance, body)
        elif isinstance(body, bytes) and body:
            place = chance.randrange(len(body))
            body = body[:place] + chance.randbytes(chance.randint(0, 9)) + body[place + 1 :]
    if method in ("GET", "HEAD", "DELETE"):
        body = None
    if isinstance(body, dict) and chance.random() < 0.1:
        text = json.dumps(body).encode()
        body = text[: chance.randrange(len(text))]
    return ("GET" if method == "HEAD" else method), path, body


def _other_path(chance, path):
    parts = path.split("/")
    place = chance.randrange(1, len(parts))
    ways = ["..", ".", "%2e%2e", "..%2f..%2foutside.toml", "%00", "a" * 300]
    odd = chance.choice([*ODD, *LINKS, *ways])
    parts[place] = odd if odd.startswith("%") or "%2f" in odd else quote(odd[:500], safe="")
    return "/".join(parts)


def _change(chance, body):
    odd = chance.choice([*ODD, *LINKS, *OUTSIDE])
    way = chance.randrange(6)
    if way == 0:
        body["settings"] = {**_settings(body), chance.choice(KEYS): odd}
    elif way == 1:
        body["settings"] = {**_settings(body), odd: odd}
    elif way == 2 and body:
        body[chance.choice([*body])] = chance.choice(
            [odd, None, 5, [], {}, [odd], {odd: odd}, True]
        )
    elif way == 3:
        body["case"] = odd
    elif way == 4 and "command" in body:
        body["command"] = chance.choice([odd, *(command.name for command in COMMANDS)])
    else:
        command = chance.choice(COMMANDS)
        names = [one.name for one in (*command.options, *command.arguments)] or ["x"]
        kind = chance.choice(["options", "arguments"])
        body[kind] = {chance.choice(names): chance.choice([odd, [odd], 1, None])}


def _settings(body):
    found = body.get("settings")
    return found if isinstance(found, dict) else {}
