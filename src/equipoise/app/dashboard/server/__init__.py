"""The process that serves the page: access, requests, broadcast."""
