"""Hexahedra of the wheel."""
