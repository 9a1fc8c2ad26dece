"""microslip in Python: what a run has written, and its plots."""
