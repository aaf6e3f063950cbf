"""Compiled functions: how they are declared, made, kept and called.

:Entry: `compiled.kernel`, the decorator of every compiled function.
:Data: `native/entries.json`: what Python calls, with which types, made by `tests/harvest.py`.
:Where: `closure` (the sources that an answer follows from), `native` (the library, called without
    Numba), `building` (how it is made), `machine_code` and `folder` (Numba's own cache), `dense`
    and `elimination` (linear algebra inside kernels).
:Tests: `unit/test_kernels`, `unit/test_compiled`, `unit/test_closure`, `unit/test_native_*`,
    `property/test_native_calls`.
"""
