"""Figures in the manner of Ivanov 2021, one a file, each a function of records."""
