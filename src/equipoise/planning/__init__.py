"""What a testbed can show before it is used: manoeuvres, reach, error budget."""
