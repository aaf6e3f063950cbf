"""A library in C as picosdk loads it, with an oscilloscope behind it that streams."""

import ctypes

import numpy as np


def pointed(place, kind):
    """What an argument points to, given with byref or as an array."""
    return place._obj if hasattr(place, "_obj") else ctypes.cast(place, ctypes.POINTER(kind))[0]


class Function:
    """A function of a library: ctypes sets its types, whoever calls it gets its status."""

    def __init__(self, act):
        self.act = act
        self.restype = self.argtypes = self.__doc__ = None

    def __call__(self, *arguments):
        return self.act(*arguments)


class FakeDriver:
    """ps4000a with a device of eight inputs: sample n of input c is n + 100 c counts, in rings.

    Attributes
    ----------
    open_status : int
        What opening answers; 286 asks for another power source.
    ready : int
        Samples that the next poll finds.
    overflow : int
        Bits of the inputs that the device says are over their range.
    """

    def __init__(self):
        self.open_status, self.ready, self.overflow = 0, 0, 0
        self.status = {}
        self.enabled, self.buffers, self.calls = {}, {}, []
        self.written = 0
        self.running = False

    def __getattr__(self, name):
        if not name.startswith("ps4000a"):
            raise AttributeError(name)
        act = getattr(self, f"_{name.removeprefix('ps4000a')}", None)

        def called(*arguments):
            self.calls.append(name.removeprefix("ps4000a"))
            if (status := self.status.get(self.calls[-1])) is not None:
                return status
            return 0 if act is None else act(*arguments) or 0

        function = Function(called)
        self.__dict__[name] = function
        return function

    def _OpenUnit(self, handle, _serial):
        pointed(handle, ctypes.c_int16).value = 1
        return self.open_status

    def _GetUnitInfo(self, _handle, text, _length, _needed, what):
        text.value = {3: b"4824A", 4: b"JO123/456"}[what]

    def _SetChannel(self, _handle, channel, enabled, _coupling, limit, _offset):
        self.enabled[channel] = limit if enabled else None

    def _SetDataBuffers(self, _handle, channel, buffer, _least, length, _segment, _mode):
        memory = (ctypes.c_int16 * length).from_address(buffer)
        self.buffers[channel] = np.frombuffer(memory, np.int16)

    def _RunStreaming(self, _handle, interval, *_rest):
        # A device takes the next interval it can.
        pointed(interval, ctypes.c_uint32).value = -(-interval._obj.value // 100) * 100
        self.running, self.written = True, 0

    def _GetStreamingLatestValues(self, handle, ready, parameter):
        assert self.running
        if not self.ready:
            return 0x27
        length = next(iter(self.buffers.values())).size
        while self.ready:
            first = self.written % length
            count = min(self.ready, length - first)
            for channel, buffer in self.buffers.items():
                numbers = np.arange(self.written, self.written + count) + 100 * channel
                buffer[first : first + count] = numbers % 30000
            self.written += count
            self.ready -= count
            ready(handle.value, count, first, self.overflow, 0, 0, 0, parameter)
        # What is not copied in time is written over.
        for buffer in self.buffers.values():
            buffer[:] = -1
        return 0

    def _Stop(self, _handle):
        self.running = False
