"""Ports to records and back: drivers, links, and the real bench made of them."""
