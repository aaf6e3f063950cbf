"""Files: whole or not at all, in folders of the user's own; cases and data that ship.

:Entry: `store.write_text` and its like: a temporary file, renamed; `store.read_text`, with a bound.
:Data: `cases/` of the checkout or the package (`shipped`).
:Where: `folders` (where caches stand), `caches` (what is in them, and its removal), `leftovers` (of
    killed processes), `together` (several files, all or none).
:Tests: `unit/test_store`, `acceptance/test_cli_cache`.
"""
