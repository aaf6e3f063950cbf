"""``asperity page`` begins and ends: its address, its folder, its port, and what it refuses."""

import socket
import subprocess
import sys

import pytest
from apparatus.page import Served

from asperity.files.shipped import shipped_cases


@pytest.mark.slow
@pytest.mark.parametrize(("name", "screen"), [("gearset-3", "gear"), ("rig-final", "rig")])
def test_a_case_is_opened_on_its_screen_in_its_own_folder(tmp_path, new_user, name, screen):
    mine = tmp_path / "cases" / "mine.toml"
    mine.parent.mkdir()
    mine.write_text(shipped_cases()[name].read_text("utf-8"))
    page = Served(tmp_path, new_user(), mine)
    try:
        assert (page.screen, page.case) == (screen, "mine.toml")
        assert page.get("/api/about").json["folder"] == str(mine.parent)
        assert page.get("/api/case/mine.toml").status == 200
    finally:
        assert page.close() == ("", "")
    assert page.process.returncode == 0


def test_what_cannot_be_served_is_refused_in_one_line(asperity, tmp_path):
    mine = tmp_path / "mine.toml"
    mine.write_text("[slider]\n")
    (tmp_path / "other").mkdir()
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        refused = {
            ("--port", port): f"--port {port}: address already in use",
            ("--port", 70000): "--port 70000: it must be from 1 to 65535",
            ("--folder", mine): "cannot be used as output folder",
            (tmp_path / "none.toml",): "none.toml",
            (mine, "--folder", tmp_path / "other"): "leave --folder out",
        }
        for arguments, words in refused.items():
            code, output, errors = asperity("page", "--no-browser", *arguments, cwd=tmp_path)
            assert (code, output) == (2, "")
            assert words in errors
            assert errors.count("\n") == 1


def test_the_command_line_is_as_light_as_it_was():
    loaded = "import asperity.cli.application, sys; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", loaded], capture_output=True, text=True, check=True
    )
    assert not {"starlette", "uvicorn", "anyio", "asyncio"} & {*done.stdout.split()}


@pytest.mark.slow
def test_the_server_imports_nothing_that_computes():
    loaded = "import asperity.web.serve, asperity.web.app, uvicorn, sys; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", loaded], capture_output=True, text=True, check=True
    )
    heavy = {"numpy", "scipy", "numba", "pydantic", "xarray", "matplotlib", "pandas", "h5py"}
    assert not heavy & {*done.stdout.split()}
