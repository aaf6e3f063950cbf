"""Who a warm worker is asked by, one after the other."""

import asyncio
import sys

import pytest

from asperity.processes import sessions
from asperity.web import warm_worker


def test_who_has_gone_by_the_time_it_is_his_turn_is_passed_over(tmp_path, monkeypatch):
    began = []

    async def main():
        owner = warm_worker.WarmWorker("solver", tmp_path)
        owner.up.set()
        owner.ready.set()
        free = asyncio.Event()

        async def answer(_verb, body, _seconds, _gone):
            began.append(body)
            await free.wait()
            return 200, body

        monkeypatch.setattr(owner, "_answer", answer)
        monkeypatch.setattr(sessions, "lives", lambda _: True)
        left = set()

        def asked(number):
            async def gone():
                return number in left

            return owner.ask("slide", b"%d" % number, gone)

        asks = [asyncio.create_task(asked(number)) for number in range(12)]
        while not began:
            await asyncio.sleep(0)
        # While the first is answered, all go but the last.
        left.update(range(1, 11))
        free.set()
        return await asyncio.gather(*asks)

    answers = asyncio.run(main())
    assert began == [b"0", b"11"]
    assert [status for status, _ in answers] == [200, *[499] * 10, 200]


@pytest.fixture
def begun(tmp_path, monkeypatch):
    """Processes that are up and ready, and answer nothing; they are begun instead of solvers."""
    script = tmp_path / "silent.py"
    script.write_text(
        'import sys\nprint("{\\"up\\": 1}\\n{\\"ready\\": 1}", flush=True)\nsys.stdin.read()\n'
    )
    begun, begin = [], asyncio.create_subprocess_exec

    async def silent(*_):
        pipe = asyncio.subprocess.PIPE
        begun.append(
            await begin(
                sys.executable, str(script), stdin=pipe, stdout=pipe, start_new_session=True
            )
        )
        return begun[-1]

    monkeypatch.setattr(sessions, "begun", silent)
    yield begun
    for process in begun:
        if process.returncode is None:
            process.kill()


def test_one_that_is_stopped_while_somebody_waits_is_not_begun_anew(tmp_path, begun):
    """As when a page is ended while it solves: it would wait for ever for the new one to end."""

    async def main():
        owner = warm_worker.WarmWorker("solver", tmp_path)
        await owner.start()
        await owner.ready.wait()

        async def gone():
            return False

        asked = asyncio.create_task(owner.ask("slide", b"", gone))
        await asyncio.sleep(0.1)
        assert not asked.done()
        await asyncio.wait_for(owner.stop(), 10.0)
        return await asyncio.wait_for(asked, 10.0)

    status, _ = asyncio.run(main())
    assert status == 500


def test_one_that_is_stopped_while_it_begins_leaves_no_process(tmp_path, begun):
    async def main():
        owner = warm_worker.WarmWorker("solver", tmp_path)
        begins = asyncio.create_task(owner.start())
        await asyncio.sleep(0)
        await owner.stop()
        await begins
        assert not begun or begun[0].returncode is not None

    asyncio.run(main())
    assert len(begun) == 1
