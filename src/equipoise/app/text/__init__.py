"""Numbers, tables and blocks of text, the same for terminal, report and page."""
