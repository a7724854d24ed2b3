"""A platform on a planar table: mass properties, slope and friction map from one record."""
