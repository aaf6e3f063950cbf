"""Bodies of smooth patches, and their files."""
