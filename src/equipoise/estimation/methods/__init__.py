"""One method, one file: a card and what it names."""
