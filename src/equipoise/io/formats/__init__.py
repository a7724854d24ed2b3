"""Tables: CSV, Excel, Parquet and MAT, and compressed files of whatever kind."""
