"""Bodies as solids: boundary representations and STEP."""
