"""The way in: a case file of one's own, begun from what is known."""
