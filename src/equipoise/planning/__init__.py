"""Predictions for a testbed before its use: manoeuvres, reach, error budget."""
