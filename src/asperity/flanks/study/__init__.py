"""The commands about flanks: what is asked, the answer and its pictures."""
