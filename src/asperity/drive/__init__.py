"""A worm gearset under load and under vibration: teeth, shafts, march over time, protocols."""
