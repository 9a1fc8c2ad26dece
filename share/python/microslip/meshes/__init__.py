"""Meshes of other codes: one reader per format, each gives a `Content`; `gmsh_file` writes it for the program."""
