"""Many runs: where they are carried out, in which chunks, and how their results are kept."""
