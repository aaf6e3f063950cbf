"""Chapter 6: the disc-on-disc rig."""
