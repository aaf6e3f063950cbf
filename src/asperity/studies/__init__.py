"""Studies of a worm gearset: sensitivity, ways to less friction, optimum, trade-off, catalogue.

:Entry: a command a module: `sensitivity`, `methods`, `optimise`, `tradeoff`, `catalogue`,
    `proposals` (`asperity size`).
:Data: a case of `asperity.rating`; ways to less friction in `data/methods.toml`.
:Where: `climb` (the highest point under constraints), `design` (what is free), `series` (standard
    series), `rounding`, `chosen` and `with_shafts` (what shafts and bearings bear).
:Tests: `unit/test_studies_*`, `literature/test_sensitivity`, `acceptance/test_cli_studies`.
"""
