"""Checks of a recording's rows: noise, outliers, clocks, averaging."""
