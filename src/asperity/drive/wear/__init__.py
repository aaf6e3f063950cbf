"""A loaded wheel that beds in and wears: Archard's law over the pitch, step by step."""
