"""Two elastic half-spaces in normal contact on a grid of rectangles: pressure patch by patch."""
