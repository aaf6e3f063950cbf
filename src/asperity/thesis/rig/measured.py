"""What survives of the rig's measurements: Tables 6.1 and 6.3, and numbers in the text."""

import numpy as np

GRAVITY, PLATFORM, PRINTED_DEAD_MASS = 9.81, 5.36, 9.1
"""m/s2 of (72), kg (6.4.1), and kg as the text has the dead mass (6.4.8)."""

POUND, POUND_FORCE = 0.45359237, 4.4482216152605
"""kg and N."""

DRY_SUPPLY = 17.1
"""Of the steel disc's motor in Table 6.3, V (6.3.4)."""

LOADS_LB = np.array([0.0, 2.0, 4.0, 8.0, 11.0])
PRINTED_LOADS = np.array([0.0, 0.9, 1.8, 3.6, 5.0])
"""Of Table 6.3, printed as N."""
STEEL_RPM = np.array([1000.0, 990.0, 975.0, 942.0, 926.0])
STEEL_CURRENT = np.array([2.35, 2.50, 2.80, 4.10, 4.50])
BRONZE_RPM = np.array([18.7, 20.5, 21.7, 96.5, 256.6])
BRONZE_CURRENT = np.array([0.8, 0.5, 0.4, 0.0, 0.0])
PRINTED_SLIDING = np.array([2001.0, 1971.0, 1934.0, 1493.0, 663.0])
PRINTED_ROLLING = np.array([1094.0, 1088.0, 1075.0, 1226.0, 1608.0])
PRINTED_RATIO = np.array([0.92, 0.91, 0.90, 0.61, 0.21])
"""Table 6.3: dry, V_ms 17.1 V, V_ma 1 V; velocities in mm/s."""

ROUGHNESS = {
    "bronze": np.array([[0.76, 0.76, 0.76], [0.74, 0.72, 0.72], [0.80, 0.80, 0.80]]),
    "steel": np.array([[0.76, 0.76, 0.76], [0.92, 0.90, 0.92], [0.78, 0.78, 0.76]]),
}
"""Table 6.1: Ra in um, three readings at each of three places."""

TORQUES = (0.6448, 0.0925)
"""N m, at 1 V before and with transverse vibration at 750 Hz in oil (6.4.11)."""

SUPPLIES = (1.0, 3.0, 5.5)
SLIDE_ROLL = (0.44, 0.88, 0.94)
"""Printed slide-roll ratios at those supplies, V (6.4.7)."""

FREQUENCIES = (250.0, 500.0, 750.0, 1000.0, 2000.0, 3000.0)
"""Of the vibration, Hz (6.4.2)."""

AMPLITUDES = {"transverse": 0.059, "longitudinal": 0.087}
"""v_a at 750 Hz, m/s (6.5.2, 6.6.2)."""

LARGEST = (0.86, 0.78)
"""Reductions of the torque, transverse and longitudinal (6.8)."""

STROKE = 32e-6
"""m (6.4.4)."""

SLIDING = (2e-3, 90e-3)
"""m/s, the range of v_sl (6.4.7)."""
