"""Records as charts, replays and correlations: blocks that a page shows to be used."""
