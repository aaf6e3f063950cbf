"""What vibration is worth over frequency and amplitude, in an actuator's stroke, over gearsets."""
