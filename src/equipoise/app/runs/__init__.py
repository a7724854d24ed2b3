"""A command's work: procedures wired to benches and files."""
