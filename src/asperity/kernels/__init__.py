"""Compiled functions: how they are declared, made, kept and called."""
