"""What a recording says of its own sensors: zeros, signs, ratios, drive, accelerometer."""
