"""The front door for programs: a verb a file, which takes records or paths and returns records."""
