"""A body pulled over a vibrating base: march, periodic state, homogenised law, closed forms."""
