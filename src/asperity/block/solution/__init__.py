"""How a block is solved: refused early, marched or settled, looked at for flutter, kept."""
