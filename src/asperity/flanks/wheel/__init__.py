"""The enveloped wheel as its hob leaves it."""
