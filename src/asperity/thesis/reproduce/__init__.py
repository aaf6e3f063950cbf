"""A run: what is made, found again and written."""
