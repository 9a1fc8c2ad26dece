"""The plate of share/scenes/plate, solved in our own finite elements."""


def plate_model(mesh, clamped=("root",)):
    """What a scene says from [model] to [supports], of a mesh file in millimetres."""
    names = ", ".join(f'"{name}"' for name in clamped)
    return f"""[model]
kind = "mesh"
file = "{mesh}"
length_unit = "mm"
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
density = 7800
[supports]
clamped = [{names}]
"""
