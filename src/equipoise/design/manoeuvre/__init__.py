"""Which manoeuvre shows most, before it is made."""
