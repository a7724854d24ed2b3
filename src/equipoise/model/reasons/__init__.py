"""What happened, as codes with numbers; the sentence of each code stands beside it."""
