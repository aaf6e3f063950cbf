"""How worm and wheel touch and move."""
