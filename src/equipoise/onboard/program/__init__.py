"""What runs on a micro-controller, as scalar Python: a row goes in, masses' displacements come out.

Python runs these functions as they stand, and the translator writes them as C.
"""
