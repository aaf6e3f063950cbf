"""What the page costs: bytes and memory of a slider that is dragged."""

import os
import socket
import time

import pytest
from apparatus.page import Served, memory

PERIODIC = {"solve.method": "periodic"}
CHANGES = 1000


@pytest.mark.slow
def test_a_thousand_changes_cost_little_and_leave_nothing_behind(page):
    def change(number):
        settings = PERIODIC | {"vibration.direction": f"{number % 90} deg"}
        answer = page.do("slide", "table-4.3", settings)
        assert answer.status == 200
        return len(answer.body)

    worker = page.child("worker")
    processes = page.process.pid, worker
    for number in range(100):
        change(number)
    held = [*map(memory, processes)]
    # How long they take is measured in benchmarks/page.py: machines differ.
    assert max(change(number) for number in range(CHANGES)) <= 16 * 1024
    assert memory(processes[0]) <= 80
    assert memory(worker) <= 300
    for process, before in zip(processes, held, strict=True):
        assert memory(process) - before < 5.0


@pytest.mark.slow
def test_a_page_is_seen_while_its_kernels_are_compiled_and_lives_by_itself(tmp_path):
    # Nothing is compiled for this user.
    page = Served(tmp_path / "folder", {**os.environ, "ASPERITY_CACHE": str(tmp_path / "cache")})
    try:
        assert page.get("/").status == 200
        assert not page.get("/api/about").json["ready"]
        # What needs no kernel is answered meanwhile, the rest as soon as it can be.
        assert page.do("rate", "gearset-3").status == 200
        assert not page.get("/api/about").json["ready"]
        assert page.do("slide", "table-4.3", PERIODIC).status == 200
        assert page.get("/api/about").json["ready"]
    finally:
        assert page.close() == ("", "")


@pytest.mark.slow
def test_what_nobody_waits_for_any_more_is_given_up(page):
    asked = b'{"case": "body-shaken-along", "settings": {"slider.normal_force": "1e9 N"}}'
    head = ("POST /api/do/slide HTTP/1.1", *page.own, "Content-Type: application/json",
            f"Content-Length: {len(asked)}", "", "")  # fmt: skip
    page.do("slide", "table-4.3", PERIODIC)
    with socket.create_connection(("127.0.0.1", page.port)) as connection:
        connection.sendall("\r\n".join(head).encode() + asked)
        time.sleep(0.5)
        worker = page.child("worker")
    assert page.do("slide", "table-4.3", PERIODIC).status == 200
    # It would have taken its ten seconds.
    assert page.child("worker") != worker
