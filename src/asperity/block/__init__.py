"""The elastic block on a vibrating base: from case to pictures, and decks of other programs."""
