"""Functions of time that are known at rows: integrals, slopes, straight pieces, memory."""
