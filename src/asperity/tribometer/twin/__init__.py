"""The simulated rig: motors, gears, contact, vibration and sensors."""
