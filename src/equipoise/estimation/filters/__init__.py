"""The published filters: one description of the model, one driver, two ways to predict.

``model`` says what a filter assumes, ``jacobian`` what its errors do; ``extended`` and
``unscented`` predict, ``correct`` corrects, ``walk`` goes along the rows, ``rows`` brings them,
``driver`` is the door and ``conclusion`` makes an estimate.
"""
