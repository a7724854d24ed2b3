"""The real bench: controller, interlocks, its process."""
