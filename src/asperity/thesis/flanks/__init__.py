"""Flanks of worm and wheel: section 2.6, and the solids of chapter 7."""
