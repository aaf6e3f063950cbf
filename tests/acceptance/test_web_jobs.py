"""Jobs of the page: begun, queued, stopped, killed, gone on with; and none left when it ends."""

import concurrent.futures
import json
import os
import shlex
import shutil
import signal
import time
from pathlib import Path

import pytest
from apparatus.page import Served, descendants, lives

PERIODIC = {"solve.method": "periodic"}
# Marched in eights, each of half a second or more: a job can be stopped between two of them.
SLOW = {"solve.method": "march", "solve.duration": "200 ms", "solve.step": "100 ns"}


def sweep(page, least, most, settings=PERIODIC, count=9):
    """Begin a sweep over directions."""
    step = (most - least) / (count - 1)
    over = [f"vibration.direction={least}:{most}:{step} deg"]
    answer = page.job("sweep", "table-4.3", settings, over=over)
    assert answer.status in (200, 429), answer.error
    return answer


@pytest.mark.slow
def test_a_job_is_the_answer_of_the_command_line_with_its_data(page, asperity):
    job = page.ended(sweep(page, 0, 40).json["id"])
    assert (job["state"], job["done"], job["total"]) == ("done", 9, 9), job
    assert {"sweep.nc", "sweep.json", "sweep.png", "report.html"} == {*job["files"]}
    answer = page.get(f"/api/jobs/{job['id']}/answer").json
    _, *words = shlex.split(job["line"])
    _, printed, _ = asperity(*words)
    wanted = json.loads(printed)
    assert answer["answer"]["ratio"] == wanted["ratio"]
    data = page.get(f"/api/jobs/{job['id']}/data?names=ratio").json
    assert data["direction"]["values"] == [0, 5, 10, 15, 20, 25, 30, 35, 40]
    assert data["ratio"]["values"] == pytest.approx(wanted["ratio"], rel=1e-5)
    assert data["ratio"]["dims"] == ["direction"]
    left = page.get(f"/api/jobs/{job['id']}/files/sweep.json")
    assert left.json["ratio"] == wanted["ratio"]
    assert "attachment" in left.headers["content-disposition"]
    for name in ("state.json", "request.json", "..%2fstate.json", "nothing", "%2e%2e"):
        assert page.get(f"/api/jobs/{job['id']}/files/{name}").status in (400, 404)
    # The same again is there already.
    assert sweep(page, 0, 40).json == {"id": job["id"], "state": "done"}


def test_what_a_job_was_asked_is_listed_as_text_and_no_link_is_followed(tmp_path):
    from asperity.web.record import Job

    job = Job("0" * 32, "sweep", "table-4.3", "asperity sweep table-4.3")
    job.home = tmp_path
    assert job.asked is None
    request = tmp_path / "request.json"
    request.write_text('{"command": "sweep", "options": {"points": NaN}}')
    assert job.asked == {"command": "sweep", "options": {"points": "NaN"}}
    request.write_text("{")
    assert job.asked is None
    request.unlink()
    (tmp_path / "private.json").write_text('{"secret": 1}')
    request.symlink_to(tmp_path / "private.json")
    assert job.asked is None


def test_a_job_that_has_ended_is_removed_with_its_files_and_nothing_else(page):
    kept = page.job("static", "table-4.4", {"friction.mu": "0.3"}).json["id"]
    identity = page.job("static", "table-4.3", {"friction.mu": "0.3"}).json["id"]
    path = f"/api/jobs/{identity}"
    while_it_runs = page.ask("DELETE", path)
    assert while_it_runs.status == 409
    assert "stop it first" in while_it_runs.error
    for each in (identity, kept):
        page.ask("POST", f"/api/jobs/{each}/stop", {})
        page.ended(each)
    assert page.ask("DELETE", path).status == 200
    assert not Path(page.folder, "jobs", identity).exists()
    assert Path(page.folder, "jobs", kept).exists()
    assert page.get(path).status == page.ask("DELETE", path).status == 404
    for name in ("..", "..%2f..", "%2e%2e", "0" * 32, "."):
        assert page.ask("DELETE", f"/api/jobs/{name}").status in (400, 404, 405)


@pytest.mark.slow
def test_what_a_job_that_is_a_link_leads_to_is_not_removed(page):
    other = Path(page.folder, "mine")
    other.mkdir(exist_ok=True)
    Path(other, "kept.csv").write_text("1,2\n")
    identity = page.job("static", "table-4.3", {"friction.mu": "0.4"}).json["id"]
    page.ask("POST", f"/api/jobs/{identity}/stop", {})
    page.ended(identity)
    home = Path(page.folder, "jobs", identity)
    shutil.rmtree(home)
    home.symlink_to(other)
    assert page.ask("DELETE", f"/api/jobs/{identity}").status == 400
    assert Path(other, "kept.csv").exists()


@pytest.mark.slow
def test_what_happens_to_a_job_is_told_as_it_happens(page):
    identity = sweep(page, 1, 41).json["id"]
    stream = page.get(f"/api/jobs/{identity}/events")
    assert stream.headers["content-type"].startswith("text/event-stream")
    lines = [line for line in stream.body.decode().split("\n\n") if line.startswith("data: ")]
    told = [json.loads(line.removeprefix("data: ")) for line in lines]
    assert told[-1]["state"] == "done"
    assert {one["state"] for one in told} <= {"queued", "running", "done"}
    assert [one["done"] for one in told] == sorted(one["done"] for one in told)


def test_a_job_of_something_else_is_another_and_of_the_same_is_the_same(page):
    asked = [("table-4.3", {}), ("table-4.3", {"friction.mu": "0.2"}), ("table-4.4", {})]
    found = [page.job("static", case, settings).json["id"] for case, settings in (*asked, asked[0])]
    assert len({*found}) == 3
    assert found[-1] == found[0]
    for identity in found[:3]:
        page.ask("POST", f"/api/jobs/{identity}/stop", b"{}", Content_Type="application/json")
        # On a fast machine it may be done by now.
        assert page.ended(identity)["state"] in ("stopped", "done")


@pytest.mark.slow
def test_what_a_command_refuses_ends_the_job_in_its_line(page):
    job = page.ended(page.job("static", "table-4.1-L1").json["id"])
    assert job["state"] == "failed"
    assert job["exit_code"] == 2
    assert "slider.mass" in job["error"]


@pytest.mark.slow
def test_of_twenty_jobs_two_run_eight_wait_and_ten_are_refused(page):
    asked = [sweep(page, n, n + 40, SLOW, 41) for n in range(20)]
    assert [answer.status for answer in asked] == [200] * 10 + [429] * 10
    assert "stop one" in asked[-1].error
    states = [job["state"] for job in page.get("/api/jobs").json]
    assert (states.count("running"), states.count("queued")) == (2, 8)
    identities = [answer.json["id"] for answer in asked[:10]]
    began = time.monotonic()
    for identity in reversed(identities):
        page.ask("POST", f"/api/jobs/{identity}/stop", b"{}", Content_Type="application/json")
    assert {page.ended(identity)["state"] for identity in identities} == {"stopped"}
    assert time.monotonic() - began < 30.0
    assert "job" not in page.children().values()


@pytest.mark.slow
def test_a_job_that_is_stopped_or_killed_goes_on_and_solves_no_point_again(page):
    # So many that even a fast machine is far from the last one when the stop reaches it.
    many = (page, 3, 43, SLOW, 161)
    identity = sweep(*many).json["id"]
    page.until(identity, lambda job: job["done"] >= 8)
    began = time.monotonic()
    page.ask("POST", f"/api/jobs/{identity}/stop", b"{}", Content_Type="application/json")
    stopped = page.ended(identity)
    assert stopped["state"] == "stopped"
    # It is ended after ten, whatever it is at.
    assert time.monotonic() - began < 15.0
    assert 8 <= stopped["done"] < 161
    assert sweep(*many).json["id"] == identity
    again = page.until(identity, lambda job: job["done"] > stopped["done"])
    os.kill(page.child("job"), signal.SIGKILL)
    killed = page.ended(identity)
    assert killed["state"] == "failed"
    assert "goes on" in killed["error"]
    sweep(*many)
    assert page.ended(identity, within=900.0)["state"] == "done"
    assert page.get(f"/api/jobs/{identity}/answer").json["answer"]["cached"] >= again["done"]


@pytest.mark.slow
def test_a_job_of_many_values_is_stopped_as_it_begins_and_gone_on_with_by_its_name(page):
    over = "vibration.velocity_ratio=" + ",".join(f"{k / 1000:.6f}" for k in range(2000, 2400))
    begun = page.job("sweep", "table-4.3", over=[over])
    assert begun.status == 200
    path = f"/api/jobs/{begun.json['id']}"
    page.ask("POST", f"{path}/stop", {})
    assert page.ended(begun.json["id"])["state"] == "stopped"
    again = page.ask("POST", f"{path}/resume", {})
    assert (again.status, again.json["id"]) == (200, begun.json["id"])
    page.until(begun.json["id"], lambda job: job["state"] == "running")
    page.ask("POST", f"{path}/stop", {})
    assert page.ended(begun.json["id"])["state"] == "stopped"


def test_the_worker_that_is_killed_is_replaced(page):
    before = page.do("slide", "table-4.3", PERIODIC).json["answer"]["ratio"]
    os.kill(page.child("worker"), signal.SIGKILL)
    time.sleep(0.2)
    assert page.do("slide", "table-4.3", PERIODIC).json["answer"]["ratio"] == before


@pytest.mark.slow
def test_an_answer_that_a_busy_machine_delays_is_no_error(page):
    page.do("slide", "table-4.3", PERIODIC)
    worker = page.child("worker")
    with concurrent.futures.ThreadPoolExecutor() as beside:
        os.kill(worker, signal.SIGSTOP)
        asked = beside.submit(page.do, "slide", "table-4.3", PERIODIC)
        time.sleep(11.0)
        os.kill(worker, signal.SIGCONT)
        answer = asked.result()
    assert answer.status == 200, answer.error
    assert page.child("worker") == worker


@pytest.mark.slow
def test_a_worker_that_does_not_answer_is_replaced_and_who_asked_is_told(page):
    before = page.do("slide", "table-4.3", PERIODIC).json["answer"]["ratio"]
    worker = page.child("worker")
    os.kill(worker, signal.SIGSTOP)
    began = time.monotonic()
    answer = page.do("slide", "table-4.3", PERIODIC)
    assert answer.status == 504
    # The limit, and what it takes to begin another on a busy machine.
    assert 29.0 < time.monotonic() - began < 60.0
    assert "took more than 30 s" in answer.error
    assert not lives(worker)
    assert page.do("slide", "table-4.3", PERIODIC).json["answer"]["ratio"] == before


def test_a_job_is_named_while_the_worker_is_at_something_else(page):
    begun = page.job("static", "table-4.3", {"friction.mu": "0.31"})
    page.do("rate", "gearset-3")
    worker = page.child("worker")
    os.kill(worker, signal.SIGSTOP)
    try:
        with concurrent.futures.ThreadPoolExecutor() as beside:
            # It waits for the worker, as a curve that is drawn would keep others waiting.
            asked = beside.submit(page.do, "rate", "gearset-3")
            again = page.job("static", "table-4.3", {"friction.mu": "0.31"})
            assert again.json["id"] == begun.json["id"]
            assert not asked.done()
            assert page.get("/api/case/table-4.3").status == 200
            assert not asked.done()
            os.kill(worker, signal.SIGCONT)
            assert asked.result().status == 200
    finally:
        os.kill(worker, signal.SIGCONT)
    page.ask("POST", f"/api/jobs/{begun.json['id']}/stop", {})
    page.ended(begun.json["id"])


@pytest.mark.slow
def test_by_ctrl_c_nothing_is_left_and_what_was_done_is_found_again(tmp_path, new_user):
    environment = new_user()
    page = Served(tmp_path, environment)
    identities = [sweep(page, n, n + 40, SLOW, 41).json["id"] for n in range(3)]
    page.until(identities[0], lambda job: job["done"] >= 8)
    below = descendants(page.process.pid)
    assert len(below) >= 3
    began = time.monotonic()
    assert page.close() == ("", "")
    assert page.process.returncode == 0
    # What does not stop is ended after ten.
    assert time.monotonic() - began < 20.0
    assert not any(map(lives, below))
    page = Served(tmp_path, environment)
    try:
        jobs = {job["id"]: job for job in page.get("/api/jobs").json}
        assert [*jobs] == identities[::-1]
        assert {jobs[identity]["state"] for identity in identities} == {"stopped"}
        assert jobs[identities[0]]["done"] >= 8
        # Gone on with by another server than began it, and stopped again.
        again = page.ask("POST", f"/api/jobs/{identities[0]}/resume", {})
        assert (again.status, again.json["state"]) == (200, "running")
        page.ask("POST", f"/api/jobs/{identities[0]}/stop", {})
        assert page.ended(identities[0])["state"] == "stopped"
    finally:
        page.close()


@pytest.mark.slow
def test_if_the_server_is_killed_its_processes_end_by_themselves(tmp_path, new_user):
    page = Served(tmp_path, new_user())
    identity = sweep(page, 0, 40, SLOW, 41).json["id"]
    page.until(identity, lambda job: job["done"] >= 1)
    below = descendants(page.process.pid)
    page.process.kill()
    # What does not stop ends itself after ten.
    deadline = time.monotonic() + 40.0
    while any(map(lives, below)):
        assert time.monotonic() < deadline
        time.sleep(0.1)
    page.close()
    state = json.loads(Path(tmp_path, "jobs", identity, "state.json").read_text())
    assert state["state"] == "running"  # nobody was left to write another
