"""Style, sheet and files of every figure."""
