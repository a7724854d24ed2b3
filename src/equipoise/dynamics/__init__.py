"""The rigid body about a fixed point in momentum form: regressor and propagator."""
