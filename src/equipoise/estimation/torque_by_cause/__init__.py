"""The torque on a platform second by second, divided among its causes."""
