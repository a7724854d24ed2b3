"""Frames, points and symbols.

N   laboratory frame, Z up, origin at the centre of rotation P.
B   body frame, fixed to the platform, same origin.
P   centre of rotation.     C   centre of mass.

A vector is in body axes unless its name ends in ``_N``. An attitude ``q`` is a unit quaternion,
scalar first, that turns body components into laboratory components: ``v_N = R(q) v_B``.
An inertia names its point (``inertia_P``, ``inertia_C``); its off-diagonal entries are tensor
elements, minus the integral of x y dm. ``com`` is PC, ``first_moment`` is mass times ``com``.

Inside the package everything is SI: m, kg, s, rad, N m. Other units appear at the edges only, and
then in the name of the key, the column or the option.
"""
