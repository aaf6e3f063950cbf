"""The command ``asperity rig check``: what a recording says of its own sensors, with pictures."""
