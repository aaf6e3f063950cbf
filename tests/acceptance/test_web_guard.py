"""Who gets through to the page, over plain sockets against a real process, and what it may read."""

import json
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

JSON = "Content-Type: application/json"
STATIC = ("/", "/index.html")
API = ("/api/about", "/api/forms", "/api/case/table-4.3", "/api/jobs", "/api/nothing")


def test_the_page_listens_on_this_machine_alone(page):
    own = {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)}
    for address in own - {"127.0.0.1"}:
        with pytest.raises(OSError, match="refused"):
            socket.create_connection((address, page.port), timeout=2)
    table = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    assert [f"0100007F:{page.port:04X}"] == [
        row[1] for row in table if row[1].endswith(f":{page.port:04X}") and row[3] == "0A"
    ]


@pytest.mark.parametrize("path", [*STATIC, *API])
def test_a_host_of_another_name_is_refused_before_anything_else(page, path):
    token = f"X-Asperity-Token: {page.token}"
    port, own = page.port, f"127.0.0.1:{page.port}"
    others = ("evil.example", "127.0.0.1", f"127.0.0.1:{port + 1}", f"evil.example:{port}",
              f"{own}.evil.example", f"[::1]:{port}", f"0.0.0.0:{port}", f"{own}, evil.example",
              "", f"user@{own}")  # fmt: skip
    for host in others:
        assert page.request(f"GET {path} HTTP/1.1", f"Host: {host}", token) == 421, host
    assert page.request(f"GET {path} HTTP/1.0", token) == 421
    assert page.request(f"GET {path} HTTP/1.1", token) == 400  # without a host it is no HTTP/1.1
    twice = (f"Host: 127.0.0.1:{page.port}", "Host: evil.example")
    assert page.request(f"GET {path} HTTP/1.1", *twice, token) in (400, 421)
    assert page.request(f"GET http://evil.example{path} HTTP/1.1", "Host: evil.example") == 421


def test_both_names_of_this_machine_are_answered(page):
    token = f"X-Asperity-Token: {page.token}"
    for host in (f"127.0.0.1:{page.port}", f"localhost:{page.port}", f"LOCALHOST:{page.port}"):
        assert page.request("GET /api/about HTTP/1.1", f"Host: {host}", token) == 200


@pytest.mark.parametrize("path", API)
@pytest.mark.parametrize("method", ["GET", "POST", "PUT", "DELETE"])
def test_without_the_token_nothing_behind_api_is_answered(page, path, method):
    host = f"Host: 127.0.0.1:{page.port}"
    for tokens in ([], [""], ["x"], [page.token[:-1]], [f"{page.token}x"], [page.token] * 2):
        headers = [f"X-Asperity-Token: {token}" for token in tokens]
        assert page.request(f"{method} {path} HTTP/1.1", host, JSON, *headers) == 403, tokens
    cookie, query = f"Cookie: token={page.token}", f"{path}?token={page.token}"
    assert page.request(f"{method} {query} HTTP/1.1", host, JSON, cookie) == 403


def test_another_page_is_refused_though_it_had_the_token(page):
    for origin in ("null", "http://evil.example", f"https://127.0.0.1:{page.port}",
                   f"http://127.0.0.1:{page.port + 1}", "http://localhost", "file://"):  # fmt: skip
        asked = page.request("GET /api/about HTTP/1.1", *page.own, f"Origin: {origin}")
        assert asked == 403, origin
    for site in ("cross-site", "same-site", "none"):
        asked = page.request("GET /api/about HTTP/1.1", *page.own, f"Sec-Fetch-Site: {site}")
        assert asked == 403, site
    own = f"Origin: http://127.0.0.1:{page.port}", "Sec-Fetch-Site: same-origin"
    assert page.request("GET /api/about HTTP/1.1", *page.own, *own) == 200


def test_a_form_cannot_post(page):
    for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data", "",
                 "application/jsonp", "text/json"):  # fmt: skip
        status = page.request("POST /api/do/slide HTTP/1.1", *page.own, f"Content-Type: {kind}",
                              "Content-Length: 2", body=b"{}")  # fmt: skip
        assert status == 415, kind
    assert page.request("POST /api/do/slide HTTP/1.1", *page.own, "Content-Length: 0") == 415


def test_no_other_page_is_told_that_it_may_ask(page):
    for method in ("OPTIONS", "GET"):
        answer = page.raw(
            f"{method} /api/about HTTP/1.1\r\nHost: 127.0.0.1:{page.port}\r\nOrigin: http://evil\r\n"
            f"Access-Control-Request-Method: POST\r\nConnection: close\r\n\r\n".encode()
        )
        assert answer.split(b" ", 2)[1] == b"403"
        assert b"access-control" not in answer.lower()


def test_every_answer_tells_the_browser_what_it_may_not_do(page):
    answers = [page.get(path) for path in (*STATIC, *API, "/nothing.js")]
    answers += [page.ask("POST", "/api/do/slide", b"x", Content_Type="text/plain"),
                page.ask("GET", "/", Host="evil.example")]  # fmt: skip
    for answer in answers:
        policy = answer.headers["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "require-trusted-types-for 'script'" in policy
        assert "unsafe" not in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert "server" not in answer.headers
    assert page.get("/api/about").headers["cache-control"] == "no-store"


def test_the_token_stands_in_the_fragment_alone(page):
    before, _, after = page.address.partition("#")
    assert page.token not in before
    assert page.token in after
    # 24 bytes, six bits a letter.
    assert len(page.token) == 32


@pytest.mark.parametrize(
    "path",
    [
        "/../pyproject.toml", "/../app.py", "/%2e%2e/app.py", "/..%2fapp.py", "/js/../../app.py",
        "//etc/passwd", "/..\\app.py", "/%00", "/.", "/static/../../guard.py", "/./../app.py",
    ],
)  # fmt: skip
def test_nothing_but_its_own_files_is_served(page, path):
    for line in (f"GET {path} HTTP/1.1", f"HEAD {path} HTTP/1.1"):
        assert page.request(line, *page.own) in (400, 404)
    for method in ("POST", "PUT", "DELETE"):
        assert page.request(f"{method} {path} HTTP/1.1", *page.own, JSON) == 405


def test_a_case_is_one_that_ships_or_one_of_the_folder(page, tmp_path):
    secret = tmp_path / "secret.toml"
    secret.write_text("[slider]\n")
    (page.folder / "link.toml").symlink_to(secret)
    for name in (str(secret), "../secret.toml", "/etc/passwd", "..", ".", "", "a/b.toml", "a\0b",
                 "link.toml", "link", "con.toml", "~/x.toml", "table-4.3/../table-4.3",
                 ".hidden.toml", "x" * 300):  # fmt: skip
        assert page.do("slide", name).status == 400, name
        assert page.job("sweep", name, over=["friction.mu=0.1,0.2"]).status == 400, name
    for name in ("..%2fsecret.toml", "%2fetc%2fpasswd", "link.toml", "%00"):
        assert page.get(f"/api/case/{name}").status in (400, 404)
    assert "link.toml" not in json.dumps(page.get("/api/about").json)


def test_no_setting_option_or_argument_names_a_file_outside_the_folder(page, tmp_path):
    outside = tmp_path / "wave.csv"
    outside.write_text("0,0\n1,1\n")
    (page.folder / "wave-link.csv").symlink_to(outside)
    shaken = {"vibration.waveform": "sampled"}
    sized = {"options": {"ratio": "40", "output_torque": "500 N m", "worm_speed": "1450 rpm"}}

    def tables(name):
        return {"rating.bs721_tables": name}

    for name in (str(outside), "../wave.csv", "/etc/passwd", "wave-link.csv", "~/../../etc/passwd"):
        refused = [
            page.do("slide", "table-4.3", shaken | {"vibration.samples": name}),
            page.do("curve", "table-4.3", shaken | {"vibration.samples": name}),
            page.do("rate", "gearset-3", {"rating.bs721_tables": name}),
            page.do("methods", "gearset-3", also=[name]),
            page.ask("POST", "/api/do/size", sized | {"settings": tables(name)}),
            page.ask("POST", "/api/do/size", sized | {"settings": tables(json.dumps(name))}),
            page.job("sweep", "table-4.3", over=[f"vibration.samples={name}"]),
            page.job("sweep", "table-4.3", over=[f"vibration.samples=a.csv,{name}"]),
            page.job("rig report", arguments={"folder": name}),
            page.job("rig reduce", arguments={"recordings": [name]}),
            page.job("rig import", "rig-final", arguments={"file": name}),
            page.job("fit", "table-4.3", arguments={"data": name}, free="friction.mu"),
            page.job("rig run", "rig-final", recordings=name),
        ]
        for answer in refused:
            # One of the home folder is none: nothing is expanded.
            assert answer.status == 400, name
            assert name.startswith("~") or "outside the folder" in answer.error, answer.error


def test_a_page_moves_no_bench_and_calls_no_other_machine(page):
    assert "sim or replay" in page.job("rig run", "rig-final", backend="hardware").error
    asked = page.job("sweep", "table-4.3", over=["friction.mu=0.1"], cluster="tcp://10.0.0.1:1")
    assert "cluster is not for a page" in asked.error


def test_an_upload_has_a_plain_name_and_a_known_ending(page):
    others = "a.exe", "a.html", "a.js", ".toml", "..%2fa.csv", "a%2fb.csv", "a%00.csv", "con.csv"
    for name in (*others, "a.csv%20", "%3Cscript%3E.csv", "x" * 120 + ".csv", "a.csv."):
        assert page.ask("PUT", f"/api/files/{name}", b"1,2\n").status in (400, 404, 405), name
    before = sorted(page.folder.iterdir())
    assert page.ask("PUT", "/api/files/good name-1.csv".replace(" ", "%20"), b"1,2\n").status == 200
    assert page.get("/api/files/good%20name-1.csv").body == b"1,2\n"
    assert len(sorted(page.folder.iterdir())) == len(before) + 1


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("e.toml", b"x = 1\n", "e.toml is no case that can be used: line 1: x stands outside"),
        ("f.toml", b"", "f.toml is no case: no command takes"),
        ("g.toml", b"\xff\xfe", "g.toml cannot be read: byte 0 is not UTF-8"),
        ("k.TOML", b"[slider]\nmas = '1 kg'\n", "k.toml is no case that can be used: line 1"),
        ("d.nc", b"hello", "d.nc is no recording of a rig, or it is damaged"),
        ("b.mat", b"hello", "b.mat cannot be read: not a MATLAB file"),
        ("a.csv?recorded", b"hello", "a.csv: row 1 is 'hello'"),
        ("t.csv", b"1,\xff\n", "t.csv cannot be read: byte 2 is not UTF-8"),
    ],
)
def test_what_nothing_reads_is_refused_by_its_name_and_leaves_nothing(page, name, content, says):
    before = sorted(page.folder.iterdir())
    answer = page.ask("PUT", f"/api/files/{name}", content)
    assert answer.status == 400
    assert answer.error.startswith(says)
    assert "upload" not in answer.error
    assert sorted(page.folder.iterdir()) == before


def test_another_file_of_a_name_takes_its_place_only_when_that_is_said(page):
    put = "/api/files/twice.csv"
    assert page.ask("PUT", put, b"1,2\n").status == 200
    assert page.ask("PUT", put, b"1,2\n").status == 200
    assert page.ask("PUT", put, b"3,4\n").status == 409
    assert page.get(put).body == b"1,2\n"
    assert page.ask("PUT", f"{put}?replace", b"3,4\n").status == 200
    assert page.get(put).body == b"3,4\n"


def test_a_check_looks_into_no_file_outside_the_folder(page, tmp_path):
    (tmp_path / "other.csv").write_text("secretword,1\n")
    named = f'samples = "{tmp_path}/other.csv"'
    text = page.do("check", "table-4.3").json["toml"]
    text = text.replace('waveform = "sine"', f'waveform = "sampled"\n{named}')
    assert named in text
    assert page.ask("POST", "/api/save", {"name": "outside", "toml": text}).status == 200
    asked = page.do("check", "outside.toml"), page.ask("PUT", "/api/files/o.toml", text.encode())
    for answer in asked:
        assert answer.status == 400
        assert "lies outside the folder" in answer.error
        assert "secretword" not in answer.error
    assert not (page.folder / "o.toml").exists()


@pytest.mark.slow
def test_a_folder_is_served_by_one_page(page, asperity_process):
    code, output, errors = asperity_process("page", "--no-browser", "--folder", page.folder)
    assert (code, output) == (2, "")
    assert f"is served already at http://127.0.0.1:{page.port}" in errors
    assert errors.count("\n") == 1


def test_a_file_that_is_a_link_is_neither_read_nor_written(page, tmp_path):
    target = tmp_path / "target.csv"
    target.write_text("kept\n")
    (page.folder / "linked.csv").symlink_to(target)
    assert page.get("/api/files/linked.csv").status == 400
    assert page.ask("PUT", "/api/files/linked.csv", b"lost\n").status == 400
    assert target.read_text() == "kept\n"


def test_what_is_too_long_is_refused_by_its_header_and_while_it_is_read(page):
    put = "PUT /api/files/long.csv HTTP/1.1"
    assert page.request(put, *page.own, "Content-Length: 256000001") == 413
    save = "POST /api/save HTTP/1.1"
    assert page.request(save, *page.own, JSON, "Content-Length: 1000001") == 413
    chunk = b"10000\r\n" + b" " * 0x10000 + b"\r\n"
    for path in ("/api/save", "/api/do/slide", "/api/jobs"):
        chunked = "Transfer-Encoding: chunked"
        status = page.request(f"POST {path} HTTP/1.1", *page.own, JSON, chunked,
                              body=chunk * 20 + b"0\r\n\r\n")  # fmt: skip
        assert status == 413, path
    assert not (page.folder / "long.csv").exists()


def test_an_upload_that_breaks_off_leaves_nothing(page):
    before = sorted(page.folder.iterdir())
    put = "PUT /api/files/half.csv HTTP/1.1"
    head = "\r\n".join((put, *page.own, "Content-Length: 100", "", ""))
    page.raw(head.encode() + b"1,2\n", breaks_off=True)
    deadline = time.monotonic() + 10.0
    while sorted(page.folder.iterdir()) != before:
        assert time.monotonic() < deadline
        time.sleep(0.01)
    assert page.get("/api/about").status == 200


@pytest.mark.parametrize(
    "sent",
    [
        b"\x16\x03\x01\x02\x00", b"GET\r\n\r\n", b"GET / HTTP/9\r\n\r\n", b"\r\n" * 50, b"\0" * 100,
        b"GET /" + b"a" * 100_000 + b" HTTP/1.1\r\n\r\n", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
    ],
)  # fmt: skip
def test_what_is_no_request_is_dropped(page, sent):
    assert b"Traceback" not in page.raw(sent, breaks_off=True)
    assert page.get("/api/about").status == 200


@pytest.mark.parametrize(
    "body",
    [b"", b"x", b"[]", b"null", b"1e999", b'"text"', b"\xff\xfe", b"[" * 5000, b'{"case": NaN}',
     b'{"case": 5}', b'{"case": "table-4.3", "settings": []}', b'{"case": ["table-4.3"]}',
     b'{"case": "table-4.3", "settings": {"friction.mu": 0.1}}',
     b'{"case": "table-4.3", "options": {"over": 1}}', b'{"settings": {}}'],
)  # fmt: skip
def test_a_body_that_says_nothing_is_told_so_in_one_line(page, body):
    for verb in ("slide", "curve", "check"):
        answer = page.ask("POST", f"/api/do/{verb}", body, Content_Type="application/json")
        assert answer.status == 400
        assert answer.json["exit_code"] == 2
        assert "\n" not in answer.error


def test_there_is_no_option_to_listen_elsewhere(environment):
    told = subprocess.run(
        [sys.executable, "-m", "asperity", "page", "--help"], env=environment,
        capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    assert "--host" not in told
