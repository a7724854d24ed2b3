"""Many runs: what methods and laws are worth."""
