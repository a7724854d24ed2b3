"""How records show themselves: a kind of record a file, as lines, tables, documents and figures."""
