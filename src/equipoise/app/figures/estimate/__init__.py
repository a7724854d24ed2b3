"""Figures of an estimate and of its fit."""
