"""Texts of worm gearsets that several tests rate."""

SMALL_FAN = """
[gearset]
starts = 1
wheel_teeth = 30
centre_distance = "26.6 mm"
diameter_factor = 10
worm_material = "case-hardened steel"
wheel_material = "CuSn12-C-GZ"
[operation]
worm_speed = "1440 rpm"
output_torque = "2 N m"
lubricant = "ISO VG 220 polyglycol"
fan = true
"""

OF_AN_ACTUATOR = """
[gearset]
starts = 1
wheel_teeth = 50
centre_distance = "100 mm"
axial_module = "3.15 mm"
diameter_factor = 12.5
worm_material = "case-hardened steel"
wheel_material = "CuSn12Ni2-C-GZ"
[operation]
lubricant = "ISO VG 220 polyglycol"
output_torque = "250 N m"
worm_speed = "1400 rpm"
"""
"""It ends in [operation], for a life or a duty cycle to follow."""

ACTUATOR = f'{OF_AN_ACTUATOR}life = "5000 h"\n'
