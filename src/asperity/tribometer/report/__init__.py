"""One page of a series of tests: plan, conditions, cells, pictures, model, what was refused."""
