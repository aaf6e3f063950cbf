"""One implicit increment of a body in contact, solved at its contact nodes."""
