"""Read a recording of a rig with h5py alone."""

import sys
import zlib

import h5py
import numpy as np


def read(path):
    with h5py.File(path) as file:
        raw, interval = file["raw"][:], float(np.ravel(file.attrs["sample_interval"])[0])
        names, units = file["signal"].asstr()[:], file["units"].asstr()[:]
        values = file["offset"][:] + file["scale"][:] * raw
        values[np.abs(raw.astype(int)) >= 32767] = np.nan  # missing, or past the range
        last = np.cumsum(file["block_count"][:])
        for rows, check in zip(np.split(raw, last)[:-1], file["block_crc32"][:], strict=True):
            if zlib.crc32(np.ascontiguousarray(rows, "<i2")) != check:
                raise ValueError(f"{path} is damaged")
        texts = (file[f"event_{key}"] for key in ("kind", "text"))
        events = [*zip(file["event_time"][:], *(text.asstr()[:] for text in texts), strict=True)]
    times = interval * np.arange(len(raw))
    return (
        times,
        dict(zip(names, values.T, strict=True)),
        dict(zip(names, units, strict=True)),
        events,
    )


if __name__ == "__main__":
    times, signals, units, events = read(sys.argv[1])
    for name, values in signals.items():
        print(f"{name} [{units[name]}]: {values.size} samples, {np.nanmean(values):.6g} on average")
