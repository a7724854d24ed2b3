"""What a recording holds and lacks, as findings."""
