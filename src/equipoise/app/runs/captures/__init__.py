"""From pictures, videos and captured bytes to recordings and lenses."""
