"""What is asked of a drive under vibration: periodic states, windows, holding, creeping."""
