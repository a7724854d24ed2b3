"""How rows are solved for the unknowns."""
