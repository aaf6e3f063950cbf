"""The page that shows claims, figures and tables."""
