"""The documentation's site: pages gathered, written from the code, drawn, and built."""
