"""The sliding body: chapter 4, and sections 2.2.2 and 2.7."""
