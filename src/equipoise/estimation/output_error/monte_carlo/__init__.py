"""Fits of many records that share their times, as a Monte Carlo makes them."""
