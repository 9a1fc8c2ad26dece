"""Figures of runs. Each module draws one kind; none keeps state, and none needs a display."""
