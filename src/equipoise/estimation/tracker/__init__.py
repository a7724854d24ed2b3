"""The multiplicative extended Kalman filter with contacts."""
