"""REXS, the exchange format of gearbox programs, version 1.5: written and read."""
