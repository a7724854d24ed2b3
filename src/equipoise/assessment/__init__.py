"""What a recording shows by itself: its quality, its content, measures of balance."""
