"""Processes beside this one, and the signals that reach them."""
