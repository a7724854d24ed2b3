"""Many runs: methods and laws compared against the simulated truth, papers reproduced."""
