"""How every long work runs: under a key of all it follows from, kept, interrupted, resumed."""
