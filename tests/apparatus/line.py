"""A pseudo-terminal with somebody at its far end, as a serial line has."""

import contextlib
import os
import pty
import select
import threading
import tty


class Line:
    """Bytes that come are answered, until the cable is pulled out.

    Attributes
    ----------
    port : str
        Where the near end is.
    """

    def __init__(self, reply):
        self._reply = reply
        self._end, self._other = pty.openpty()
        self._heard, self._stop = os.pipe()
        tty.setraw(self._other)
        self.port = os.ttyname(self._other)
        self._pulled = False
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def pull(self):
        """Pull the cable out, once nobody reads any more: a number is given to who opens next."""
        if not self._pulled:
            # In this order: what serves closes both ends as soon as it is pulled.
            os.write(self._stop, b".")
            self._pulled = True
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def _serve(self):
        with contextlib.suppress(OSError):
            while not self._pulled:
                ready, _, _ = select.select((self._end, self._heard), (), ())
                if self._end in ready and (said := self._reply(os.read(self._end, 4096))):
                    os.write(self._end, said)
        self._pulled = True
        for end in (self._end, self._other, self._heard, self._stop):
            os.close(end)
