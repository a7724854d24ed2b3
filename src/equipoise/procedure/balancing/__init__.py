"""Balance a platform: by moves, by laws, by hand."""
