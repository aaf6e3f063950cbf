"""Where two surfaces meet: their geometry, the laws of pressure and friction, and the tractions."""
