"""Variables of MAT files, version by version, and which of them make a table."""
