"""The mesh of a worm gearset reduced to one point on each flank."""
