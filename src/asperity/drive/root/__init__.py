"""Stress at the roots of loaded teeth, on a mesh of its own."""
