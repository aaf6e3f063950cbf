"""A page served by a process of its own, and what is said to it over a plain socket."""

import contextlib
import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

_ADDRESS = re.compile(r"http://127\.0\.0\.1:(\d+)/#/(\w+)\?(?:case=([^&]*)&)?token=([\w-]+)")


class Reply(NamedTuple):
    """Status, headers in lower case, and body."""

    status: int
    headers: dict[str, str]
    body: bytes

    @property
    def json(self):
        return json.loads(self.body)

    @property
    def error(self):
        return self.json["error"]


class Served:
    """``asperity page`` in a process."""

    def __init__(self, folder, environment, *arguments):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "asperity", "page", "--no-browser", *map(str, arguments)],
            cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True, start_new_session=True,
        )  # fmt: skip
        self.address = self.process.stdout.readline().strip()
        found = _ADDRESS.fullmatch(self.address)
        assert found, (self.address, self.process.stderr.read() if not self.address else "")
        self.port, self.screen, self.case, self.token = int(found[1]), *found.groups()[1:]

    def ask(self, method, path, body=None, **headers):
        """Ask as the page does; headers of None are left out, a body that is no bytes is JSON."""
        sent = {"X-Asperity-Token": self.token}
        if body is not None and not isinstance(body, bytes):
            body, sent["Content-Type"] = json.dumps(body).encode(), "application/json"
        sent |= {name.replace("_", "-"): value for name, value in headers.items()}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)
        with contextlib.closing(connection):
            connection.putrequest(method, path, skip_host="Host" in sent)
            for name, value in sent.items():
                if value is not None:
                    connection.putheader(name, value)
            if body is not None:
                connection.putheader("Content-Length", str(len(body)))
            connection.endheaders(body)
            return _reply(connection.getresponse())

    def get(self, path):
        """Return what a path answers."""
        return self.ask("GET", path)

    def do(self, verb, case, settings=None, **options):
        """Ask for a live answer."""
        body = {"case": case, "settings": settings or {}, "options": options}
        return self.ask("POST", f"/api/do/{verb}", body)

    def job(self, command, case="", settings=None, arguments=None, **options):
        """Begin a job."""
        body = {"command": command, "case": case, "settings": settings or {},
                "arguments": arguments or {}, "options": options}  # fmt: skip
        return self.ask("POST", "/api/jobs", body)

    def ended(self, identity, within=120.0):
        """Return a job once it has ended."""
        return self.until(identity, lambda job: job["state"] in ("done", "stopped", "failed"),
                          within)  # fmt: skip

    def until(self, identity, holds, within=120.0):
        """Return a job once something holds of it."""
        deadline = time.monotonic() + within
        while not holds(job := self.get(f"/api/jobs/{identity}").json):
            assert time.monotonic() < deadline, job
            time.sleep(0.05)
        return job

    def raw(self, sent, *, breaks_off=False):
        """Send bytes as they are; returns all that comes back until the server closes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=30) as connection:
            with contextlib.suppress(BrokenPipeError, ConnectionResetError):
                connection.sendall(sent)
            if breaks_off:
                connection.shutdown(socket.SHUT_WR)
            found = b""
            with contextlib.suppress(ConnectionResetError):
                while more := connection.recv(65536):
                    found += more
            return found

    def request(self, line, *headers, body=b""):
        """Send a request with exactly these headers; returns its status."""
        text = "\r\n".join((line, *headers, "Connection: close", "", "")).encode("latin-1")
        answer = self.raw(text + body)
        return int(answer.split(b" ", 2)[1]) if answer else 0

    @property
    def own(self):
        """The headers of an honest request."""
        return (f"Host: 127.0.0.1:{self.port}", f"X-Asperity-Token: {self.token}")

    def children(self):
        """Return the processes it began, by what they do."""
        found = {}
        for pid in descendants(self.process.pid):
            with contextlib.suppress(OSError):
                words = Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
                if "-m" in words:
                    what, first = words[words.index("-m") + 1 :][:2]
                    found[pid] = "lookup" if first == "lookup" else what.rpartition(".")[2]
        return found

    def child(self, kind):
        """Return a process of a kind."""
        return next(pid for pid, what in self.children().items() if what == kind)

    def close(self, number=signal.SIGINT, within=120.0):
        """End it; returns what it printed besides its address, and its complaints."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        try:
            return self.process.communicate(timeout=within)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)


def _reply(response):
    headers = {name.lower(): value for name, value in response.getheaders()}
    return Reply(response.status, headers, response.read())


def descendants(pid):
    """Return the processes below one."""
    found = []
    for path in Path(f"/proc/{pid}/task").glob("*/children"):
        with contextlib.suppress(OSError):
            for child in map(int, path.read_text().split()):
                found += [child, *descendants(child)]
    return found


def lives(pid):
    """Whether a process runs; one that has ended and is not collected does not."""
    try:
        return "\nState:\tZ" not in Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return False


def memory(pid):
    """Return what a process holds in memory, MB."""
    found = re.search(r"VmRSS:\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text())
    return int(found[1]) / 1024
