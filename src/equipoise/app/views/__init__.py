"""Results as blocks, documents and figures; nothing is computed here."""
