"""The elastic teeth in motion: the mesh that a march advances, tooth by tooth."""
