"""Signs, factors and guards that are broken on purpose: tests have to notice each."""
