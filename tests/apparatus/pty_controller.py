"""A vibration controller at the other end of a pseudo-terminal, with faults."""

import contextlib
import os
import pty
import threading
import tty

DIALECT = {
    "set_waveform": "WAVE {waveform}",
    "set_frequency": "FREQ {frequency:.0f}",
    "start": "START",
    "stop": "STOP",
    "answer": "OK",
    "identify": "WHO?",
    "ask_frequency": "FREQ?",
    "keep_alive": "HERE",
    "sine": "SIN",
    "triangle": "TRI",
}


class PtyController:
    """Answers lines that end with CR LF.

    Attributes
    ----------
    port : str
        Where the other end is.
    fault : str
        ``""``, ``"silent"``, ``"half"``, ``"wrong"`` or ``"deaf"`` (says OK and does nothing).
    """

    def __init__(self):
        self._end, self._other = pty.openpty()
        tty.setraw(self._other)
        self.port = os.ttyname(self._other)
        self.fault, self.frequency, self.waveform, self.vibrates = "", 0.0, "", False
        self.heard = []
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def pull(self):
        """Pull the cable out."""
        for end in (self._end, self._other):
            with contextlib.suppress(OSError):
                os.close(end)

    def _serve(self):
        text = b""
        while True:
            try:
                text += os.read(self._end, 256)
            except OSError:
                return
            while b"\r\n" in text:
                line, text = text.split(b"\r\n", 1)
                answer = self._answer(line.decode("utf-8", "replace"))
                if self.fault == "silent":
                    continue
                sent = answer.encode() + b"\r\n"
                if self.fault == "half":
                    sent = sent[: len(sent) // 2]
                try:
                    os.write(self._end, sent)
                except OSError:
                    return

    def _answer(self, line):
        self.heard.append(line)
        word, _, value = line.partition(" ")
        if self.fault == "wrong":
            return "?"
        if self.fault == "deaf":
            return f"{self.frequency:.0f}" if line == "FREQ?" else "OK"
        if line == "FREQ?":
            return f"{self.frequency:.0f}"
        if line == "WHO?":
            return "GEN 1"
        if word == "FREQ":
            self.frequency = float(value)
        if word == "WAVE":
            self.waveform = value
        if word in ("START", "STOP"):
            self.vibrates = word == "START"
        return "OK"
