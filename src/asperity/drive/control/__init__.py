"""A stroke whose vibration comes and goes: controller, its sensor and filter, or a clutch.

`parameters` has the table ``[control]``, `sensor` what a torque sensor beside the vibration reads,
`switching` who decides, `stroke` the march, `study` the command `control`.
"""
