"""What worm and wheel measure: over pins and balls, tooth thickness, backlash, a drawing's data."""
