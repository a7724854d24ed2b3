"""The motion of a simulated platform that is not rigid."""
