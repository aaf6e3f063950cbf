"""The elastic block: chapter 5, and section 7.3."""
