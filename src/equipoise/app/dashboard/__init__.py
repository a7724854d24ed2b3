"""The live dashboard: a page, its server, and the runner that has the bench, each in a process."""
