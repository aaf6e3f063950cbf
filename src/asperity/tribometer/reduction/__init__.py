"""From recordings to numbers: segments, levels of torque, ratios with honest intervals."""
