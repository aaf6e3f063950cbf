"""Instruments of a rig: what each kind can do, and the makers' devices behind that."""
