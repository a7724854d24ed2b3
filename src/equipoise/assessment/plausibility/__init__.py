"""Whether a record can be what it says it is: gates before any fit."""
