"""The published filters: one description of the model, one prediction, one correction, one driver.

``model`` says what a filter believes, ``jacobian`` what its errors do, ``predict`` and ``correct``
are its two stages, ``walk`` goes along the rows, ``rows`` brings them, ``driver`` is the door.
"""
