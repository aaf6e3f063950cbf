"""What a hob leaves of a blank, compiled."""
