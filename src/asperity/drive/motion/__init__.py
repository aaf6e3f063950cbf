"""The march of a worm gearset over time: freedoms, imposed motions, ledger, periodic state."""
