"""The contact pattern."""
