"""Table formats: CSV, Excel, Parquet, MAT, ULog, ROS bags, and compressed files of these."""
