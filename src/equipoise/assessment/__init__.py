"""What a record says by itself: one metric, one file."""
