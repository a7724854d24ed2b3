"""Commands, dashboard and reports: where people, files and benches meet the algorithms."""
