"""Who a warm worker is asked by, one after the other."""

import asyncio

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
