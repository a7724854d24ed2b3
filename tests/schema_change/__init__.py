"""JSON documents of twenty fixed runs, before and after a change that must keep behaviour."""
