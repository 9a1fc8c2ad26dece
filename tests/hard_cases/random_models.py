"""Random scenes of kinds that random_runs.py has no points for: bars, blocks on rough areas with moments, chains with areas and
several contacts, small meshes with their modes, one contact or two, and points with one to seven harmonics.

Hard: as in random_runs.py; a contact is of many points, moments lift some of them, and modes come from a mesh.
Met in: campaigns, which were of points and chains alone.
Right: as in random_runs.py, which runs them.

model_of(seed, number) gives (kind, law, harmonics), the scene and how its rows are marched through (None: they are not); a mesh is
written beside the scene by write_mesh().
"""
import math
import random

from random_runs import ACCURACY, Draw, inline, modal_scene

HARMONICS = (1, 2, 3, 4, 5, 6, 7)
LOW = 0.5  # kinetic coefficient of a law, of the static one


def model_of(seed, number):
    draw = Draw(f"models {seed}.{number}")
    kind, law, make = KINDS[number % len(KINDS)]
    harmonics = 1 if number < len(KINDS) else draw.choice(HARMONICS)
    text, how = make(draw, law, harmonics)
    return (kind, law, harmonics), text + ACCURACY, how


def friction(law, mu, rate):
    """The value of a coefficient, and the law as the march knows it."""
    if law == "exponential":
        return f'{{ law = "exponential", static = {mu}, kinetic = {LOW * mu}, rate = {rate} }}', (law, mu, LOW * mu, rate)
    if law == "hyperbolic":
        return f'{{ law = "hyperbolic", static = {mu}, rate = {rate} }}', (law, mu, 0.0, rate)
    return repr(mu), None


def roughness(law, height):
    """`both`: each surface has its own, of one law."""
    if law == "both":
        return f'roughness = [{{ law = "cubic", height = {height} }}, {{ law = "cubic", height = {0.3 * height} }}]\n'
    return f'roughness = {{ law = "{law}", height = {height} }}\n' if law in ("cubic", "gaussian") else ""


def points(draw, law, harmonics):
    """As random_runs.py draws them, of as many harmonics as are asked for."""
    text, modal = modal_scene(draw, law, harmonics, planar=False)
    return text.replace(ACCURACY, ""), None if law in ("cubic", "gaussian") else "modal"


def plane(draw, law, harmonics):
    return modal_scene(draw, law, min(harmonics, 4), planar=True)[0].replace(ACCURACY, ""), None


def bar(draw, _law, harmonics):
    """Loads that are even, zero somewhere, or low in the middle; one mode to eight."""
    length, area, modulus, density = draw.uniform(0.2, 2.0), draw.log(1e-5, 1e-3), 2.1e11, 7800.0
    end = draw.choice(('"clamped"', repr(modulus * area / length * draw.log(0.1, 100.0))))
    frequency = math.sqrt(modulus / density) / (4.0 * length)
    force = draw.log(1.0, 1e3)
    shape = draw.choice(("1", "x/L", "0.2 + 0.8*(2*x/L - 1)^2"))
    total = force * draw.log(0.1, 30.0)
    return f"""[model]
kind = "bar"
youngs_modulus = {modulus}
area = {area}
density = {density}
length = {length}
end_stiffness = {end}
[modes]
count = {draw.randint(1, 8)}
damping_ratio = {draw.log(1e-4, 0.05)}
residual = "{draw.choice(("none", "stiffness"))}"
[contact]
tangential_stiffness = {modulus * area / length**2 * draw.log(1e-2, 10.0)}
friction_coefficient = {draw.log(0.05, 1.0)}
load = "{total / length}*({shape})"
points = {draw.randint(3, 60)}
[excitation]
force = {force}
[response]
frequency = [{frequency * draw.uniform(0.3, 0.8)}, {frequency * draw.uniform(1.3, 4.0)}]
harmonics = {harmonics}
""", 1.0


def block(draw, law, harmonics):
    """Slides and rocks; rough or smooth, pressed beside its middle by moments it can bear."""
    side, mass = draw.log(0.02, 0.3), draw.log(0.1, 10.0)
    frequency = [draw.log(10.0, 100.0)]
    frequency += [frequency[0] * draw.uniform(1.05, 2.0) for _ in range(5)]
    inertia = [mass * side**2 * draw.uniform(0.1, 0.4) for _ in range(3)]
    spring = [(mass if i < 3 else inertia[i - 3]) * (2.0 * math.pi * f)**2 for i, f in enumerate(frequency)]
    force = draw.log(0.1, 100.0)
    preload = force * draw.log(0.3, 20.0)
    stiffness = spring[0] * draw.log(0.1, 10.0)
    size = force / stiffness
    coefficient, _ = friction(law, draw.log(0.05, 1.0), draw.log(0.1, 10.0) / (size * 2.0 * math.pi * frequency[0]))
    moments = [preload * side * draw.uniform(-0.12, 0.12) for _ in range(2)]
    planar = draw.random() < 0.4
    loads = [f"{{ at = {draw.row(3, 0.3 * side)}, force = [{force}, 0, 0], moment = {draw.row(3, 0.2 * force * side)} }}"]
    if planar:
        loads.append(f"{{ at = [0, 0, 0], force = [0, 0, {force * draw.log(0.1, 1.0)}], phase = 90 }}")
    return f"""[model]
kind = "block"
mass = {mass}
moments_of_inertia = {inertia}
height = {side * draw.uniform(0.1, 0.5)}
stiffness = {spring[:3]}
rotational_stiffness = {spring[3:]}
[modes]
damping_ratio = {draw.log(1e-3, 0.05)}
[contact]
cells = [{draw.randint(2, 3)}, {draw.randint(2, 3)}]
size = [{side}, {side * draw.uniform(0.5, 1.0)}]
normal_stiffness = {stiffness * draw.log(0.3, 3.0)}
tangential_stiffness = {stiffness}
friction_coefficient = {coefficient}
{roughness(law, size * draw.log(0.1, 10.0))}preload_moment = {moments}
[excitation]
forces = [ {", ".join(loads)} ]
[response]
output = {{ at = [0, 0, 0], direction = [1, 0, 0] }}
frequency = [{frequency[0] * draw.uniform(0.5, 0.9)}, {max(frequency[:3]) * draw.uniform(1.1, 1.6)}]
harmonics = {min(harmonics, 3) if planar else harmonics}
preload = [{preload}]
[effects]
second_direction = "{"auto" if planar else "off"}"
""", None


def chain(draw, law, harmonics):
    """Two or three contacts, one of them an area under a moment, one pressed by the next mass."""
    n = draw.randint(2, 4)
    masses = [draw.log(0.3, 3.0) for _ in range(n)]
    springs = [draw.log(2e4, 2e5) for _ in range(n)]
    force = draw.log(0.3, 30.0)
    load = force * draw.log(0.3, 20.0)
    contacts, plain = [], law != "areas"
    for number in range(draw.randint(2, 3)):
        a = draw.randint(1, n)
        b = a % n + 1
        slip = draw.choice((f'"m{a}"', f"{{ m{a} = 1, m{b} = -1 }}"))
        words = f"slip = {slip}, tangential_stiffness = {draw.log(5e3, 5e5)}, friction_coefficient = {draw.log(0.05, 1.0)}"
        words += f", share = {draw.uniform(0.2, 1.0)}"
        if draw.random() < 0.4 and "{" not in slip:
            words += f', approach = "m{b}", normal_stiffness = {draw.log(5e3, 5e5)}'
        if not plain and number == 0:
            words += f", cells = [{draw.randint(2, 4)}, {draw.randint(2, 4)}], size = [0.1, 0.1]"
            words += f", preload_moment = {draw.row(2, 0.1 * 0.1 * 0.2 * load)}"
        contacts.append(f"  {{ {words} }},\n")
    low = math.sqrt(min(springs) / max(masses)) / (2.0 * math.pi)
    return f"""[model]
kind = "chain"
masses = {masses}
springs = {springs}
[modes]
damping_ratio = {draw.log(1e-3, 0.05)}
[contact]
points = [
{"".join(contacts)}]
[excitation]
forces = [ {{ at = "m{draw.randint(1, n)}", amplitude = {force} }} ]
[response]
output = "m{draw.randint(1, n)}"
frequency = [{0.3 * low}, {3.0 * low}]
harmonics = {harmonics}
preload = [ {load} ]
""", None


def mesh(draw, law, harmonics):
    """A cantilever of bricks (write_mesh) that rubs with its upper face or with both: bent one way, so that friction is along a line."""
    two, force = law == "two contacts", draw.log(0.1, 10.0)
    load = force * draw.log(0.1, 20.0)
    sign, header = (-1.0 if draw.random() < 0.2 else 1.0), "[[contact]]" if two else "[contact]"
    coefficient, known = friction(law, draw.log(0.05, 1.0), draw.log(1.0, 1e3))
    contacts = "".join(f"""{header}
surface = "{surface}"
slip_direction = [1, 0, 0]
friction_coefficient = {coefficient}
normal_stiffness = {draw.log(1e9, 1e12)}
tangential_stiffness = {draw.log(1e9, 1e12)}
fit = "{draw.choice(("auto", "none"))}"
points = {draw.choice((4, 12, 40))}
""" for surface in (("top", "bottom") if two else ("top",)))
    return f"""[model]
kind = "mesh"
file = "cantilever.msh"
[material]
youngs_modulus = 2.1e11
poissons_ratio = 0.3
density = 7800
[supports]
clamped = ["root"]
[modes]
count = {draw.randint(1, 5)}
damping_ratio = {draw.log(5e-4, 0.02)}
residual = "{draw.choice(("none", "stiffness", "attachment"))}"
{contacts}[excitation]
forces = [ {{ at = "tip", direction = [{draw.uniform(-1.0, 1.0)}, 0, 1], amplitude = {force} }} ]
[response]
output = {{ at = "tip", direction = [0, 0, 1] }}
frequency = [{draw.uniform(300.0, 700.0)}, {draw.uniform(1200.0, 2500.0)}]
harmonics = {min(harmonics, 5)}
preload = [ {sign * load} ]
[effects]
second_direction = "off"
""", None if two or sign < 0.0 or "attachment" in contacts else ("law", known, load)


def write_mesh(path):
    """gmsh 2.2: 8 × 1 × 1 bricks of 100 × 20 × 10 mm with the faces root, top, bottom and the node tip."""
    nx, size = 8, (0.1, 0.02, 0.01)
    node = lambda i, j, k: 1 + i + (nx + 1) * (j + 2 * k)
    elements = []
    for i in range(nx):
        elements.append((5, 1, [node(i, 0, 0), node(i + 1, 0, 0), node(i + 1, 1, 0), node(i, 1, 0),
                                node(i, 0, 1), node(i + 1, 0, 1), node(i + 1, 1, 1), node(i, 1, 1)]))
    elements.append((3, 2, [node(0, 0, 0), node(0, 0, 1), node(0, 1, 1), node(0, 1, 0)]))
    for i in range(nx // 2, nx):
        elements.append((3, 4, [node(i, 0, 1), node(i + 1, 0, 1), node(i + 1, 1, 1), node(i, 1, 1)]))
        elements.append((3, 5, [node(i, 0, 0), node(i, 1, 0), node(i + 1, 1, 0), node(i + 1, 0, 0)]))
    elements.append((15, 3, [node(nx, 0, 1)]))
    with open(path, "w", encoding="ascii") as out:
        out.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n3 1 "body"\n2 2 "root"\n0 3 "tip"\n2 4 "top"\n2 5 "bottom"\n'
                  f"$EndPhysicalNames\n$Nodes\n{4 * (nx + 1)}\n")
        for k in range(2):
            for j in range(2):
                for i in range(nx + 1):
                    out.write(f"{node(i, j, k)} {size[0] * i / nx:.17g} {size[1] * j:.17g} {size[2] * k:.17g}\n")
        out.write(f"$EndNodes\n$Elements\n{len(elements)}\n")
        for number, (kind, group, nodes) in enumerate(elements, start=1):
            out.write(f"{number} {kind} 2 {group} {group} {' '.join(map(str, nodes))}\n")
        out.write("$EndElements\n")


KINDS = [("points", "constant", points), ("bar", "constant", bar), ("block", "cubic", block), ("mesh", "constant", mesh),
         ("chain", "contacts", chain), ("points", "exponential", points), ("block", "exponential", block), ("bar", "constant", bar),
         ("mesh", "two contacts", mesh), ("chain", "areas", chain), ("block", "both", block), ("points", "hyperbolic", points),
         ("mesh", "hyperbolic", mesh), ("block", "constant", block), ("plane", "hyperbolic", plane), ("points", "gaussian", points)]
