"""Which manoeuvre tells most, before it is made."""
