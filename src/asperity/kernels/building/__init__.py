"""Machine code of kernels made in advance: a library for a wheel, single entries for a checkout."""
