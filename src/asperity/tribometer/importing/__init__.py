"""Recordings out of the files of oscilloscope programs: one small reader a format."""
