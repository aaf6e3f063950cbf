"""Chapter 7's gearset under vibration: its claims, figures and tables."""
