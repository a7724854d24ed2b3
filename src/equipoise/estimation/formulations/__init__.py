"""What a method believes of the motion, as rows that are linear in the unknowns."""
