"""Rolling bearings: equivalent loads, lives and static safety by ISO 281 and ISO 76."""
