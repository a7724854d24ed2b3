"""How many of the units in which people at a bench think are in one SI unit: um, mm, g, deg, uN m.

Results stay SI; these factors are for sentences and for the edges.
"""

import math

PER_DEG = 180 / math.pi
UM, MM, GRAM, MICRO = 1e6, 1e3, 1e3, 1e6
