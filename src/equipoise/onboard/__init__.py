"""Estimator and law for a micro-controller: the library's own scalar functions, written as C99."""
