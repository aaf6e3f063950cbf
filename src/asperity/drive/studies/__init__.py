"""What vibration is worth in an actuator's stroke, and in which gearsets."""
