"""How a recording is laid out in its file."""

FORMAT = "asperity recording 1"
"""Of the attribute ``format``."""

MISSING, BEYOND = -32768, 32767
"""Counts that are no values: a sample that is missing, and one past the range (also negative)."""

LARGEST = BEYOND - 1
"""The largest count that is a value."""

SAMPLE, CHANNEL, EVENT, BLOCK = "sample", "channel", "event", "block"
RAW = "raw"

CHANNELS = {
    "signal": (str, "1", "what is on the channel"),
    "units": (str, "1", "unit of offset + scale times raw"),
    "scale": (float, "1", "of a count, in the channel's unit"),
    "offset": (float, "1", "of a count of zero, in the channel's unit"),
}
EVENTS = {
    "event_time": (float, "s", "time of an event since the start"),
    "event_kind": (str, "1", "kind of an event"),
    "event_text": (str, "1", "what happened"),
}
BLOCKS = {
    "block_first": (int, "1", "number of a block's first sample by the device's count"),
    "block_count": (int, "1", "samples of a block"),
    "block_clock": (float, "s", "computer's clock when a block had come, since the start"),
    "block_crc32": (int, "1", "check sum of a block's counts"),
}
"""Variables beside the counts: what they hold, their unit and meaning."""
