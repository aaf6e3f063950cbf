"""How far a gearset may be from its numbers: tolerances, grades, and the backlash they leave."""
