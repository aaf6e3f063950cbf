"""Files: whole or not at all, in folders of the user's own; cases and data that ship."""
