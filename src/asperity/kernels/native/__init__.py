"""Kernels that were compiled before: a library of machine code that is called without Numba."""
