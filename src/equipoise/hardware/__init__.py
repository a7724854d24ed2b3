"""Ports to nouns and back: drivers of motor boards and sensors, and the bench made of them."""
