"""What sensors measure of a platform: times, frames, noise."""
