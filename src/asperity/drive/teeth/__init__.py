"""The wheel's elastic teeth and what the worm does to them."""
