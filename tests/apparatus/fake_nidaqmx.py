"""A stand-in for the maker's package nidaqmx: its names, and a device that samples by a clock."""

import enum
import sys
import types

import numpy as np


class DaqError(Exception):
    """What the driver raises."""


class TerminalConfiguration(enum.Enum):
    DEFAULT, RSE, NRSE, DIFF = -1, 10083, 10078, 10106


class AcquisitionType(enum.Enum):
    CONTINUOUS, FINITE = 10123, 10178


class _Chans(list):
    def add_ai_voltage_chan(self, name, terminal_config, min_val, max_val):
        if not name.startswith("Dev1/ai"):
            raise DaqError(f"Physical channel specified does not exist on this device.\n{name}")
        self.append((name, terminal_config, min_val, max_val))


class _Timing:
    samp_clk_rate = 0.0

    def cfg_samp_clk_timing(self, rate, sample_mode, samps_per_chan):
        assert sample_mode is AcquisitionType.CONTINUOUS
        # A clock that is divided from 100 MHz.
        self.samp_clk_rate = 100e6 / round(100e6 / rate)
        self.buffer = samps_per_chan


class Task:
    made = []  # noqa: RUF012

    def __init__(self):
        self.ai_channels, self.timing = _Chans(), _Timing()
        self.in_stream = self
        self.waiting, self.given, self.running, self.closed = 0, 0, False, False
        self.lost = False
        Task.made.append(self)

    @property
    def avail_samp_per_chan(self):
        if self.lost:
            raise DaqError("The application is not able to keep up.\n\nStatus Code: -200279")
        return self.waiting

    def start(self):
        self.running = True

    def stop(self):
        self.running = False

    def close(self):
        self.closed = True


class AnalogMultiChannelReader:
    def __init__(self, task):
        self.task = task

    def read_many_sample(self, data, number_of_samples_per_channel, timeout):
        task = self.task
        assert data.shape == (len(task.ai_channels), number_of_samples_per_channel)
        number = task.given + np.arange(number_of_samples_per_channel)
        for row, channel in zip(data, task.ai_channels, strict=True):
            row[:] = channel[3] * np.sin(1e-3 * number) * task.__dict__.get("gain", 0.5)
        task.given += number_of_samples_per_channel
        task.waiting -= number_of_samples_per_channel


class Device:
    def __init__(self, name):
        if name != "Dev1":
            raise DaqError("Device identifier is invalid.\nStatus Code: -200220")
        self.product_type, self.serial_num = "USB-6343", 0x1A2B3C4


def plugged_in(monkeypatch):
    """Let the package be there."""
    parts = {
        "nidaqmx": {"Task": Task},
        "nidaqmx.errors": {"DaqError": DaqError},
        "nidaqmx.constants": {
            "TerminalConfiguration": TerminalConfiguration, "AcquisitionType": AcquisitionType,
        },
        "nidaqmx.stream_readers": {"AnalogMultiChannelReader": AnalogMultiChannelReader},
        "nidaqmx.system": {"Device": Device},
    }  # fmt: skip
    Task.made.clear()
    for name, held in parts.items():
        module = types.ModuleType(name)
        for key, value in held.items():
            setattr(module, key, value)
        monkeypatch.setitem(sys.modules, name, module)
        top, _, last = name.rpartition(".")
        if top:
            setattr(sys.modules[top], last, module)
