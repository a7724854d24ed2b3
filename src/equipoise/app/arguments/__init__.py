"""What commands take: options, their checks, and files and names resolved to records."""
