"""Bags and messages of ROS 1 and ROS 2."""
