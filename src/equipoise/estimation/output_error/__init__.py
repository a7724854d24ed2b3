"""The maximum-likelihood output-error fit by multiple shooting."""
