"""The test procedure: steps, checks, interlocks and the journal that a run goes on from."""
