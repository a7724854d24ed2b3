"""Tables (CSV, Excel, Parquet, MAT), logs of ROS and of flight controllers, compressed files."""
