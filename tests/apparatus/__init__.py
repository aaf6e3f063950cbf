"""Independent ways to the answers of the package, for its tests and benchmarks to compare with."""
