"""A vibration controller at the other end of a pseudo-terminal, with faults."""

from apparatus.line import Line

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


class PtyController(Line):
    """Answers lines that end with CR LF.

    Attributes
    ----------
    port : str
        Where the other end is.
    fault : str
        ``""``, ``"silent"``, ``"half"``, ``"wrong"`` or ``"deaf"`` (says OK and does nothing).
    """

    def __init__(self):
        self.fault, self.frequency, self.waveform, self.vibrates = "", 0.0, "", False
        self.heard = []
        self._rest = b""
        super().__init__(self._hear)

    def _hear(self, came):
        *lines, self._rest = (self._rest + came).split(b"\r\n")
        return b"".join(map(self._said, lines))

    def _said(self, line):
        sent = self._answer(line.decode("utf-8", "replace")).encode() + b"\r\n"
        if self.fault == "silent":
            return b""
        return sent[: len(sent) // 2] if self.fault == "half" else sent

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
