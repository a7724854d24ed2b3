"""The platform as laws model it: pendulum, limits, settling."""
