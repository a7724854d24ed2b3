"""A bench made of equations: truth, sensors with noise, actuators with faults."""
