"""The guardian: a process that owns a rig's outputs, outlives the procedure and switches off."""
