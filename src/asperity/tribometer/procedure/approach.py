"""Before a person is sent to the rig everything is switched off, read back, and heard to be."""

import contextlib
from collections.abc import Callable, Iterator, Mapping

from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.instruments.protocols import InstrumentError
from asperity.tribometer.procedure.logger import Logger

_TRIES, _AGAIN = 10, 0.1  # s; currents fall, and discs run out
_LISTENED = 1.0  # s


class Approach:
    """Sees that hands are safe at a rig that has run.

    Parameters
    ----------
    bench : Bench
        Its instruments.
    listener : callable
        Gives a logger of nothing, which watches the drive signal.
    on_switched : callable
        Takes what outputs were told, by their names.
    """

    def __init__(
        self,
        bench: Bench,
        listener: Callable[[None, None], Logger],
        on_switched: Callable[[Mapping[str, str]], None],
    ) -> None:
        self._bench, self._listener, self._on_switched = bench, listener, on_switched
        self._ran = False

    def ran(self) -> None:
        """Take that something is switched on."""
        self._ran = True

    @contextlib.contextmanager
    def safe(self) -> Iterator[None]:
        """Have a person sent to the rig, where everything is off, for as long as that takes.

        Raises
        ------
        InstrumentError
            As of :meth:`off`.
        """
        self.off()
        with self._bench.waiting():
            yield

    def off(self) -> None:
        """See that everything is off, the amplifier's supply too, and the drive heard still.

        Raises
        ------
        InstrumentError
            Something was not read back to be off, the drive signal moves, or it is not heard.
        """
        if not self._ran:
            return
        bench = self._bench
        if bench.amplifier is not None:
            bench.amplifier.off()
            self._on_switched({bench.amplifier.name: "off"})
        for left in range(_TRIES, -1, -1):
            found = [one for one in bench.read_back() if not one.proven]
            named = [str(one) for one in found if not one.unheard]
            if not named:
                break
            if left == 0:
                raise InstrumentError(
                    f"nobody is sent to the rig, {'; '.join(named)}", kind="still on"
                )
            bench.clock.sleep(_AGAIN)
            bench.vibration.keep_alive()
        # A controller that says it is off may go on: only its signal tells.
        try:
            self._listen()
        except InstrumentError as error:
            name = bench.vibration.name
            raise InstrumentError(
                f"nobody is sent to the rig, {name} is not heard to be still: {error}",
                kind=error.kind,
            ) from None
        self._ran = False

    def _listen(self) -> None:
        ear = self._bench.listener
        if ear is not None:
            if ear.moves():
                raise InstrumentError("its signal moves", kind="still on")
            return
        logger = self._listener(None, None)
        try:
            logger.watch(_LISTENED)
        except BaseException:
            logger.abandon()
            raise
        logger.close()
