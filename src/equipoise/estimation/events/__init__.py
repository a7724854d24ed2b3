"""Contacts and shifts within a recording: search, threshold, times."""
