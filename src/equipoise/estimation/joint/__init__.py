"""Several records of one platform: one fit, and whether they agree."""
