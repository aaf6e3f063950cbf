"""Efficiency and load capacity of worm gearsets by the standards."""
