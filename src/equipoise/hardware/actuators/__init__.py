"""Drivers of the electronics of wheels, gyros, coils and jets, one file each."""
