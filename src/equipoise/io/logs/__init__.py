"""Logs of other programs: ROS, flight controllers, inertial units, and captured bytes."""
