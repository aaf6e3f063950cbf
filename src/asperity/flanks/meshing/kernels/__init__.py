"""Where worm and wheel come nearest while they turn, compiled."""
