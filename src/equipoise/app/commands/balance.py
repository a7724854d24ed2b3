def balance() -> int:
    """balance."""
    return 0
