"""A series of tests as a repository takes it: data, results, who made them, and a licence."""
