"""Linear methods: a formulation times a solver."""
