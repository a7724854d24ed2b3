"""Tables (CSV, Parquet, MAT) and logs (ROS, PX4, ArduPilot, MAVLink, VectorNav)."""
