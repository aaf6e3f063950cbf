"""Instruments at the other end of a pseudo-terminal or socket, which answer as their manuals say.

Written from the manuals that the descriptions name, not from the descriptions: a command that the
manual does not have, or that ends otherwise, is an error of the device and gets no answer.
"""

import contextlib
import re
import socket
import threading
import time
import typing

from apparatus.line import Line

LOAD = 2.0  # ohm


class Output:
    """An output of a supply with a resistor on it."""

    def __init__(self, most_volts=30.0, most_amperes=3.0):
        self.most = most_volts, most_amperes
        self.volts, self.limit, self.on = 1.0, most_amperes, False
        self.welded = False

    @property
    def amperes(self):
        on = self.on or self.welded
        return min(self.volts / LOAD, self.limit) if on else 0.0

    @property
    def measured(self):
        return self.amperes * LOAD


class Device:
    """A device that hears bytes and answers some of them.

    ``fault`` is "", "silent", "half", "garbling", "late" or "stuck" (a command to switch is taken
    and not done).
    """

    ends = b"\n"
    answers_end = b"\n"

    def __init__(self, outputs=2):
        self.outputs = {n + 1: Output() for n in range(outputs)}
        self.error, self.fault, self.heard, self.late = 0, "", [], 0.0

    def lines(self, waiting):
        """Split what has come into lines and the rest."""
        *lines, rest = waiting.split(self.ends)
        return lines, rest

    def hear(self, line):
        """Take a line; returns what is sent back, with its end."""
        line = line.decode("ascii")
        self.heard.append(line)
        before = {n: one.on for n, one in self.outputs.items()}
        answer = self.done(line)
        if self.fault == "stuck":
            for n, one in self.outputs.items():
                one.on = before[n]
        if answer is None or self.fault == "silent":
            return b""
        if self.fault == "late":
            time.sleep(self.late)
        sent = (answer if isinstance(answer, bytes) else answer.encode()) + self.answers_end
        if self.fault == "half":
            return sent[: len(sent) // 2]
        return b"?#" + self.answers_end if self.fault == "garbling" else sent

    def done(self, line):
        """Do what a line says; returns an answer, or None."""
        for pattern, act in self.commands.items():
            found = re.fullmatch(pattern, line)
            if found:
                return act(self, *found.groups())
        self.error = -113
        return None

    def set(self, output, what, value):
        place = ("volts", "limit").index(what)
        if not 0.0 <= value <= output.most[place]:
            self.error = -222
            return
        setattr(output, what, value)

    def next_error(self, none, some):
        error, self.error = self.error, 0
        return none if not error else some.format(error)


class TTi(Device):
    """PL303QMT-P: PL & PL-P Series Instruction Manual, Remote Commands."""

    answers_end = b"\r\n"
    name = "THURLBY THANDAR, PL303QMT-P, 279730, 1.04-4.06"

    def __init__(self):
        super().__init__(3)

    commands: typing.ClassVar = {
        r"\*IDN\?": lambda s: s.name,
        r"V([123]) ([\d.]+)": lambda s, n, v: s.set(s.outputs[int(n)], "volts", float(v)),
        r"I([123]) ([\d.]+)": lambda s, n, v: s.set(s.outputs[int(n)], "limit", float(v)),
        r"V([123])\?": lambda s, n: f"V{n} {s.outputs[int(n)].volts:.3f}",
        r"I([123])\?": lambda s, n: f"I{n} {s.outputs[int(n)].limit:.4f}",
        r"V([123])O\?": lambda s, n: f"{s.outputs[int(n)].measured:.3f}V",
        r"I([123])O\?": lambda s, n: f"{s.outputs[int(n)].amperes:.3f}A",
        r"OP([123]) ([01])": lambda s, n, on: setattr(s.outputs[int(n)], "on", on == "1"),
        r"OP([123])\?": lambda s, n: str(int(s.outputs[int(n)].on)),
        r"EER\?": lambda s: s.next_error("0", "100"),
    }


class RigolDP800(Device):
    """DP832: DP800 Series Programming Guide."""

    name = "RIGOL TECHNOLOGIES,DP832,DP8A204201234,00.01.16"

    def __init__(self):
        super().__init__(3)

    commands: typing.ClassVar = {
        r"\*IDN\?": lambda s: s.name,
        r":SOUR([123]):VOLT ([\d.]+)": lambda s, n, v: s.set(s.outputs[int(n)], "volts", float(v)),
        r":SOUR([123]):CURR ([\d.]+)": lambda s, n, v: s.set(s.outputs[int(n)], "limit", float(v)),
        r":SOUR([123]):VOLT\?": lambda s, n: f"{s.outputs[int(n)].volts:.3f}",
        r":SOUR([123]):CURR\?": lambda s, n: f"{s.outputs[int(n)].limit:.3f}",
        r":MEAS:VOLT\? CH([123])": lambda s, n: f"{s.outputs[int(n)].measured:.4f}",
        r":MEAS:CURR\? CH([123])": lambda s, n: f"{s.outputs[int(n)].amperes:.4f}",
        r":OUTP CH([123]),(ON|OFF)": lambda s, n, on: setattr(s.outputs[int(n)], "on", on == "ON"),
        r":OUTP\? CH([123])": lambda s, n: "ON" if s.outputs[int(n)].on else "OFF",
        r":SYST:ERR\?": lambda s: s.next_error('0,"No error"', '{},"Undefined header"'),
    }


class KeysightE36300(Device):
    """E36312A: E36300 Series Programming Guide."""

    name = "Keysight Technologies,E36312A,MY57001234,2.1.0-1.0.4-1.12"

    def __init__(self):
        super().__init__(3)

    commands: typing.ClassVar = {
        r"\*IDN\?": lambda s: s.name,
        r"VOLT ([\d.]+),\(@([123])\)": lambda s, v, n: s.set(s.outputs[int(n)], "volts", float(v)),
        r"CURR ([\d.]+),\(@([123])\)": lambda s, v, n: s.set(s.outputs[int(n)], "limit", float(v)),
        r"VOLT\? \(@([123])\)": lambda s, n: f"{s.outputs[int(n)].volts:+.8E}",
        r"CURR\? \(@([123])\)": lambda s, n: f"{s.outputs[int(n)].limit:+.8E}",
        r"MEAS:VOLT\? \(@([123])\)": lambda s, n: f"{s.outputs[int(n)].measured:+.8E}",
        r"MEAS:CURR\? \(@([123])\)": lambda s, n: f"{s.outputs[int(n)].amperes:+.8E}",
        r"OUTP (ON|OFF),\(@([123])\)": lambda s, on, n: setattr(
            s.outputs[int(n)], "on", on == "ON"
        ),
        r"OUTP\? \(@([123])\)": lambda s, n: str(int(s.outputs[int(n)].on)),
        r"SYST:ERR\?": lambda s: s.next_error('+0,"No error"', '{},"Data out of range"'),
    }


class HMP(Device):
    """HMP4040: HMP Series SCPI Programmers Manual; one set of lines for the selected output."""

    name = "ROHDE&SCHWARZ,HMP4040,100123,HW50020001/SW2.51"

    def __init__(self):
        super().__init__(4)
        self.selected = 1

    @property
    def at(self):
        return self.outputs[self.selected]

    commands: typing.ClassVar = {
        r"\*IDN\?": lambda s: s.name,
        r"INST OUT([1234])": lambda s, n: setattr(s, "selected", int(n)),
        r"VOLT ([\d.]+)": lambda s, v: s.set(s.at, "volts", float(v)),
        r"CURR ([\d.]+)": lambda s, v: s.set(s.at, "limit", float(v)),
        r"VOLT\?": lambda s: f"{s.at.volts:.3f}",
        r"CURR\?": lambda s: f"{s.at.limit:.4f}",
        r"MEAS:VOLT\?": lambda s: f"{s.at.measured:.3f}",
        r"MEAS:CURR\?": lambda s: f"{s.at.amperes:.4f}",
        r"OUTP (ON|OFF)": lambda s, on: setattr(s.at, "on", on == "ON"),
        r"OUTP\?": lambda s: str(int(s.at.on)),
        r"SYST:ERR\?": lambda s: s.next_error('0,"No error"', '{},"Data out of range"'),
    }


class Korad(Device):
    """KA3005P: no end of a line either way, a byte for the state, 50 ms between commands."""

    answers_end = b""
    name = "KORADKA3005PV2.0"

    def __init__(self):
        super().__init__(1)

    def lines(self, waiting):
        # It acts on what has come when nothing more comes. On a busy machine this here reads late,
        # and two commands at once, which the device has heard one after the other.
        text, found = waiting.decode("ascii"), []
        while word := next(filter(None, (re.match(each, text) for each in self.commands)), None):
            found.append(word[0].encode())
            text = text[word.end() :]
        return [*found, *([text.encode()] if text else [])], b""

    @property
    def at(self):
        return self.outputs[1]

    commands: typing.ClassVar = {
        r"\*IDN\?": lambda s: s.name,
        r"VSET1:(\d\d\.\d\d)": lambda s, v: s.set(s.at, "volts", float(v)),
        r"ISET1:(\d\.\d\d\d)": lambda s, v: s.set(s.at, "limit", float(v)),
        r"VSET1\?": lambda s: f"{s.at.volts:05.2f}",
        r"ISET1\?": lambda s: f"{s.at.limit:.3f}",
        r"VOUT1\?": lambda s: f"{s.at.measured:05.2f}",
        r"IOUT1\?": lambda s: f"{s.at.amperes:.3f}",
        r"OUT([01])": lambda s, on: setattr(s.at, "on", on == "1"),
        r"STATUS\?": lambda s: bytes([0x11 | (s.at.on << 6)]),
    }


class Generator(Device):
    """What generators share: at most 10 V either side of zero into an open circuit."""

    def __init__(self):
        super().__init__(1)
        self.shape, self.frequency, self.amplitude, self.offset = "SIN", 1000.0, 0.1, 0.0
        self.load = "50"

    @property
    def at(self):
        return self.outputs[1]

    def level(self, what, value):
        levels = {"amplitude": self.amplitude, "offset": self.offset, what: value}
        if abs(levels["offset"]) + 0.5 * levels["amplitude"] > 10.0:
            self.error = -221
            return
        setattr(self, what, value)


class Keysight33500(Generator):
    """33511B: Trueform Series Operating and Service Guide."""

    name = "Agilent Technologies,33511B,MY52301234,2.03-1.19-2.00-52-00"
    commands: typing.ClassVar = {
        r"\*IDN\?": lambda s: s.name,
        r"OUTP1:LOAD (INF|\d+)": lambda s, load: setattr(s, "load", load),
        r"SOUR1:VOLT ([\d.]+)": lambda s, v: s.level("amplitude", float(v)),
        r"SOUR1:VOLT:OFFS (-?[\d.]+)": lambda s, v: s.level("offset", float(v)),
        r"SOUR1:VOLT\?": lambda s: f"{s.amplitude:+.15E}",
        r"SOUR1:VOLT:OFFS\?": lambda s: f"{s.offset:+.15E}",
        r"SOUR1:FUNC (SIN|SQU|TRI|RAMP)": lambda s, shape: setattr(s, "shape", shape),
        r"SOUR1:FREQ ([\d.]+)": lambda s, f: setattr(s, "frequency", float(f)),
        r"SOUR1:FREQ\?": lambda s: f"{s.frequency:+.15E}",
        r"OUTP1 (ON|OFF)": lambda s, on: setattr(s.at, "on", on == "ON"),
        r"OUTP1\?": lambda s: str(int(s.at.on)),
        r"SYST:ERR\?": lambda s: s.next_error('+0,"No error"', '{},"Settings conflict"'),
    }


class SiglentSDG(Generator):
    """SDG2042X: Programming Guide PG02; a setting it cannot take is left out without a word."""

    name = "Siglent Technologies,SDG2042X,SDG2XCAX1R1234,2.01.01.23R7"

    def wave(self, text):
        parts = text.split(",")
        for key, value in zip(parts[::2], parts[1::2], strict=True):
            if key == "WVTP":
                self.shape = value
            elif key == "FRQ":
                self.frequency = float(value)
            elif key == "AMP":
                self.level("amplitude", float(value))
            elif key == "OFST":
                self.level("offset", float(value))
            elif key == "SYM":
                self.symmetry = float(value)

    def output(self, text):
        if text.startswith("LOAD,"):
            self.load = text[5:]
        else:
            self.at.on = text == "ON"

    commands: typing.ClassVar = {
        r"\*IDN\?": lambda s: s.name,
        r"C1:BSWV ((?:[A-Z]+,[\w.+-]+,?)+)": lambda s, text: s.wave(text),
        r"C1:BSWV\?": lambda s: (
            f"C1:BSWV WVTP,{s.shape},FRQ,{s.frequency:g}HZ,PERI,{1 / s.frequency:g}S,"
            f"AMP,{s.amplitude:g}V,OFST,{s.offset:g}V,HLEV,{s.offset + s.amplitude / 2:g}V,"
            f"LLEV,{s.offset - s.amplitude / 2:g}V,PHSE,0"
        ),
        r"C1:OUTP (ON|OFF|LOAD,\w+)": lambda s, text: s.output(text),
        r"C1:OUTP\?": lambda s: f"C1:OUTP {'ON' if s.at.on else 'OFF'},LOAD,{s.load},PLRT,NOR",
    }


class OnPty(Line):
    """A device on a pseudo-terminal."""

    def __init__(self, device):
        self.device, self._rest = device, b""
        super().__init__(self._hear)

    def _hear(self, came):
        lines, self._rest = self.device.lines(self._rest + came)
        return b"".join(map(self.device.hear, lines))


class OnSocket:
    """A device at a socket of this computer, as a VISA address."""

    def __init__(self, device):
        self.device = device
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.address = f"TCPIP::127.0.0.1::{self._listening.getsockname()[1]}::SOCKET"
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        while True:
            try:
                line, _ = self._listening.accept()
            except OSError:
                return
            with line:
                rest = b""
                while came := line.recv(4096):
                    lines, rest = self.device.lines(rest + came)
                    for each in lines:
                        line.sendall(self.device.hear(each))

    def pull(self):
        """Take it away."""
        with contextlib.suppress(OSError):
            self._listening.shutdown(socket.SHUT_RDWR)
        self._listening.close()
