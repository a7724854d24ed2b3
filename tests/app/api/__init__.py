"""Tests of the front door for programs."""
