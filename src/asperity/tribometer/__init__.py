"""The disc-on-disc tribometer: configuration, recordings, reduction, laws fitted to data."""
