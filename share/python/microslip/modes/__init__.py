"""Readers of modes that other codes computed: each gives a Modes (content.py) of one file."""
