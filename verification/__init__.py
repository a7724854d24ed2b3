"""The long checks behind the claims of the README, one file a claim; `make verify` runs them.

Each file has one pure function ``measure(seeds, spread) -> Result``. The tests in
``tests/statistical`` call the same functions with fewer seeds.
"""
