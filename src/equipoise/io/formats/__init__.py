"""Table formats: CSV, Parquet, MAT, ULog, ROS bags."""
