"""What somebody leaves in a folder, sends half, or sets around a command does no harm."""

import asyncio
import json
import os
import socket
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
import scipy.io

from asperity.errors import InputError, StorageError
from asperity.files.store import read_dataset
from asperity.processes.alone import alone
from asperity.tribometer.importing.mat import read_mat
from asperity.tribometer.recording.recording import Recording
from asperity.web import guard, patience, serve
from asperity.web.folder import ANSWER, REQUEST, STATE, Folder
from asperity.web.guard import Refused
from asperity.web.jobs import Jobs


@pytest.mark.parametrize("name", [".asperity-page", ".rig-run"])
def test_a_link_where_a_folder_is_held_is_refused_and_what_it_leads_to_is_kept(tmp_path, name):
    target = tmp_path / "target"
    target.write_text("kept\n")
    (tmp_path / name).symlink_to(target)
    with pytest.raises(StorageError, match="is a link"), alone(tmp_path / name, "is held"):
        pass
    assert target.read_text() == "kept\n"
    (tmp_path / name).unlink()
    (tmp_path / name).symlink_to(tmp_path / "nowhere")
    with pytest.raises(StorageError, match="is a link"), alone(tmp_path / name, "is held"):
        pass
    assert not (tmp_path / "nowhere").exists()


@pytest.mark.slow
def test_a_page_refuses_a_folder_that_is_held_by_a_link(asperity_process, tmp_path):
    (tmp_path / "target").write_text("kept\n")
    (tmp_path / ".asperity-page").symlink_to(tmp_path / "target")
    code, output, errors = asperity_process("page", "--no-browser", "--folder", tmp_path)
    assert (code, output) == (2, "")
    assert "is a link" in errors
    assert (tmp_path / "target").read_text() == "kept\n"


def kept_job(folder, identity, **changes):
    """Leave a job in a folder as a page before would have."""
    home = folder.jobs / identity
    home.mkdir(parents=True)
    told = {"id": identity, "command": "slide", "case": "table-4.3", "line": "asperity slide",
            "state": "done", **changes}  # fmt: skip
    (home / REQUEST).write_text("{}")
    (home / STATE).write_text(json.dumps(told))
    return home


@pytest.mark.parametrize(
    "wrong",
    [{"seconds": float("nan")}, {"done": float("inf")}, {"seconds": "long"}, {"notes": 5},
     {"state": None}, {"reached": {"x": float("nan")}}],
)  # fmt: skip
def test_a_job_whose_state_is_none_takes_no_other_one_away(tmp_path, wrong):
    folder = Folder(tmp_path)
    kept_job(folder, "0" * 32)
    kept_job(folder, "1" * 32, **wrong)
    kept_job(folder, "of another name")
    listed = Jobs(folder).listed()
    assert [one["id"] for one in listed] == ["0" * 32]
    json.dumps(listed, allow_nan=False)


def test_what_a_job_left_is_no_link(page, tmp_path):
    job = page.job("slide", "table-4.3", {"solve.method": "periodic"}).json
    page.ended(job["id"])
    home = next(page.folder.rglob(f"{job['id']}/{REQUEST}")).parent
    (tmp_path / "secret").write_text('{"secret": 1}')
    (home / ANSWER).unlink()
    (home / ANSWER).symlink_to(tmp_path / "secret")
    assert page.get(f"/api/jobs/{job['id']}/answer").status == 404
    for path in home.glob("*.nc"):
        content = tmp_path / path.name
        path.replace(content)
        path.symlink_to(content)
    answer = page.get(f"/api/jobs/{job['id']}/data")
    assert answer.status == 400
    assert "has left no data" in answer.error


@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("POST", "/api/save", b'{"name": "x", "toml": "a = \\"\\ud800\\""}'),
        ("POST", "/api/save", b'{"name": "\\ud800", "toml": "a = 1"}'),
        ("POST", "/api/do/slide", b'{"case": "\\ud800", "settings": {}}'),
        ("POST", "/api/do/slide", b'{"case": "table-4.3", "settings": {"\\ud800": "\\udfff"}}'),
        ("POST", "/api/jobs", b'{"command": "slide", "case": "\\ud800"}'),
        ("PUT", "/api/files/%ED%A0%80.csv", b"1,2\n"),
    ],
)
def test_half_a_character_is_refused_in_one_line(page, method, path, body):
    kind = {"Content_Type": "application/json"} if method == "POST" else {}
    answer = page.ask(method, path, body, **kind)
    assert answer.status == 400
    assert answer.json["exit_code"]
    assert "\n" not in answer.error


def test_a_full_disk_is_told_in_one_line(tmp_path, monkeypatch):
    from asperity.web.app import Page

    def full(*_):
        raise OSError(28, os.strerror(28))

    application = Page(Folder(tmp_path)).application()
    monkeypatch.setattr("asperity.web.app.temporary_beside", lambda path: Full(path.parent / "x"))
    monkeypatch.setattr("asperity.web.app.write_text", full)
    save = b'{"name": "x", "toml": "a = 1"}'
    for method, path, body in (("PUT", "/api/files/x.csv", b"1"), ("POST", "/api/save", save)):
        status, said = asyncio.run(answered(application, method, path, body))
        assert status == 507
        assert "no space left on device" in json.loads(said)["error"]


async def answered(application, method, path, body):
    """Return what an application answers: status and body."""
    told = []

    async def receive():
        return {"type": "http.request", "body": body, "more_body": False}

    async def send(message):
        told.append(message)

    scope = {"type": "http", "method": method, "path": path, "raw_path": path.encode(),
             "query_string": b"", "headers": [], "server": ("127.0.0.1", 1), "scheme": "http",
             "root_path": "", "http_version": "1.1"}  # fmt: skip
    await application(scope, receive, send)
    return told[0]["status"], b"".join(one.get("body", b"") for one in told)


class Full(type(Path())):
    """A file on a disk that is full."""

    def open(self, *_, **__):
        raise OSError(28, os.strerror(28))


def asked_in_part(sent, monkeypatch):
    """Return what a server says to a connection that goes no further, of little patience."""
    import uvicorn

    monkeypatch.setattr(patience, "PATIENCE", 0.2)
    monkeypatch.setattr(guard, "PATIENCE", 0.2)

    async def application(scope, receive, send):
        from starlette.requests import Request
        from starlette.responses import PlainTextResponse

        said = b"".join([part async for part in guard.parts_of(Request(scope, receive), 1000)])
        await PlainTextResponse(said)(scope, receive, send)

    async def whole():
        config = uvicorn.Config(
            guard.Guard(application, "x", listening.getsockname()[1]), http=patience.Patient,
            lifespan="off", log_config=None, log_level="critical", timeout_keep_alive=1,
        )  # fmt: skip
        server = uvicorn.Server(config)
        server.capture_signals = lambda: __import__("contextlib").nullcontext()
        running = asyncio.create_task(server.serve(sockets=[listening]))
        reader, writer = await asyncio.open_connection(*listening.getsockname())
        writer.write(sent.replace(b"PORT", str(listening.getsockname()[1]).encode()))
        answer = await asyncio.wait_for(reader.read(), 20.0)
        writer.close()
        server.should_exit = True
        await running
        return answer

    with socket.create_server(("127.0.0.1", 0)) as listening:
        return asyncio.run(whole())


HEAD = b"POST /api/x HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nX-Asperity-Token: x\r\n"
HEAD += b"Content-Type: application/json\r\n"


@pytest.mark.parametrize("sent", [b"", b"GE", HEAD])
def test_a_connection_that_asks_nothing_in_the_end_is_closed(sent, monkeypatch):
    assert asked_in_part(sent, monkeypatch) == b""


def test_half_a_body_is_answered_and_a_whole_one_as_ever(monkeypatch):
    said = asked_in_part(HEAD + b"Content-Length: 9\r\n\r\nhalf", monkeypatch)
    assert said.startswith(b"HTTP/1.1 408")
    assert b"nothing more of the request has come" in said
    whole = HEAD + b"Content-Length: 4\r\n\r\nfull"
    # The second one of a connection is waited for as the first is.
    said = asked_in_part(whole + HEAD, monkeypatch)
    assert said.startswith(b"HTTP/1.1 200")
    assert said.endswith(b"full")


def test_a_body_that_stops_is_refused_where_it_is_read(monkeypatch):
    monkeypatch.setattr(guard, "PATIENCE", 0.05)

    class Still:
        def __init__(self):
            self.headers = {}

        async def stream(self):
            yield b"one"
            await asyncio.sleep(60.0)

    async def read():
        return [part async for part in guard.parts_of(Still(), 100)]

    with pytest.raises(Refused, match="nothing more of the request"):
        asyncio.run(read())


def test_the_browser_is_not_called_with_the_token(tmp_path, monkeypatch):
    called = []
    monkeypatch.setattr(serve.webbrowser, "open", called.append)
    door = tmp_path / "asperity-page.html"
    door.symlink_to(tmp_path / "elsewhere")
    serve._open("http://127.0.0.1:8321/#/start?case=a&token=secret", door)
    (address,) = called
    assert "secret" not in address
    assert address == door.as_uri()
    assert door.stat().st_mode & 0o777 == 0o600
    assert "url=http://127.0.0.1:8321/#/start?case=a&amp;token=secret" in door.read_text()
    assert not (tmp_path / "elsewhere").exists()


def test_a_small_file_that_unpacks_to_gigabytes_is_refused_before_it_does(tmp_path):
    path = tmp_path / "zeros.mat"
    # Small numbers count as what they are read as: 8 bytes each.
    samples = np.zeros((20_000_000, 1), np.int8)
    samples[::100, 0] = np.arange(200_000) % 101
    values = {"Tinterval": 1e-5, "A": samples}
    scipy.io.savemat(path, values, do_compression=True)
    assert path.stat().st_size < 1_000_000
    with pytest.raises(InputError, match="unpacks to 160 MB, as no measured samples do"):
        read_mat(path, "zeros.mat")


@pytest.mark.parametrize("read", [Recording.open, read_dataset])
def test_a_pipe_is_refused_where_a_file_is_wanted(tmp_path, read):
    pipe = tmp_path / "pipe.nc"
    os.mkfifo(pipe)
    said = []

    def asked():
        try:
            read(pipe)
        except StorageError as error:
            said.append(str(error))

    waits = threading.Thread(target=asked, daemon=True)
    waits.start()
    waits.join(20.0)
    assert said == [
        f"{pipe} cannot be read: it is a device or a pipe; save what it holds to a file"
    ]


@pytest.mark.parametrize("columns", ["99999999999999999999", "9" * 5000, "-1", "x", "0"])
def test_a_width_that_no_terminal_has_ends_nothing(asperity, environment, columns):
    env = {**environment, "COLUMNS": columns}
    for words in (["check", "table-4.3"], ["slide", "--help"], ["static", "table-4.3"]):
        code, output, errors = asperity(*words, env=env)
        assert code == 0
        assert "Traceback" not in errors
        assert output


@pytest.mark.slow
@pytest.mark.parametrize("megabytes", [1100, 1536, 2048])
def test_where_there_is_no_room_for_threads_it_is_said_or_done_without(environment, megabytes):
    code = (
        f"import resource; resource.setrlimit(resource.RLIMIT_AS, ({megabytes << 20},) * 2); "
        "from asperity.cli.main import main; main(['optimise', 'gearset-3', '--json'])"
    )
    env = {key: value for key, value in environment.items() if "THREADS" not in key}
    done = subprocess.run(
        [sys.executable, "-c", code], env=env, capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    assert done.returncode in (0, 1, 2, 3), done.stderr
    assert "Traceback" not in done.stderr
