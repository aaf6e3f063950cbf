"""Parameters of a friction law from measured ratios or forces, and what the data cannot tell."""
