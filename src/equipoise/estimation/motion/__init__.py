"""Attitude and rate from sensors, before any fit."""
