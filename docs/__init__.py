"""The documentation, and in `site` the program that makes the site of it."""
