"""Meshes written in the formats of other codes, node orders and faces written down anew from the codes' manuals: the
tests must not take them from the readers.

A mesh here is nodes (n × 3), blocks {VTK's name: connectivity in VTK's order, from 0}, surfaces {name: corner nodes of
its faces} and points {name: nodes}.
"""
import dataclasses
import types

import numpy as np

# Faces of each element by its corners, numbered from 1, in the order of the codes' own face numbers.
ABAQUS_FACES = {"tetra": ("123", "142", "243", "341"),
                "hexahedron": ("1234", "5876", "1562", "2673", "3784", "4851"),
                "wedge": ("123", "465", "1452", "2563", "3641"),
                "pyramid": ("1234", "152", "253", "354", "451")}
EXODUS_FACES = {"tetra": ("124", "234", "143", "132"),
                "hexahedron": ("1265", "2376", "3487", "1584", "1432", "5678"),
                "wedge": ("1254", "2365", "1463", "132", "456"),
                "pyramid": ("125", "235", "345", "154", "1432")}
# Place in VTK's order of every node of the file, where they differ.
RING_BY_RING = {"tetra10": (0, 4, 1, 5, 2, 6, 7, 8, 9, 3),
                "hexahedron20": (0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15),
                "wedge15": (0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11)}
UPRIGHT_EDGES_FIRST = {"hexahedron20": (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15),
                       "wedge15": (0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11)}
# MED numbers the corners as seen in a mirror, edges from corner to corner as VTK does.
MED = {"tetra": (0, 2, 1, 3), "tetra10": (0, 2, 1, 3, 6, 5, 4, 7, 9, 8), "hexahedron": (0, 3, 2, 1, 4, 7, 6, 5),
       "hexahedron20": (0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17),
       "wedge": (0, 2, 1, 3, 5, 4), "wedge15": (0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13),
       "pyramid": (0, 3, 2, 1, 4), "pyramid13": (0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10)}


@dataclasses.dataclass
class Mesh:
    nodes: np.ndarray
    blocks: dict
    surfaces: dict = dataclasses.field(default_factory=dict)
    points: dict = dataclasses.field(default_factory=dict)

    def nodes_of(self, surface):
        """All nodes on a surface, those on its edges too."""
        faces = {frozenset(face) for face in self.surfaces[surface]}
        found = set()
        for kind, rows in self.blocks.items():
            corners = [[int(digit) - 1 for digit in face] for face in ABAQUS_FACES[kind.rstrip("0123456789")]]
            for row in rows:
                for face in corners:
                    if frozenset(row[face]) in faces:
                        found.update(row[_with_edges(kind, face)])
        return sorted(int(node) for node in found)


def _with_edges(kind, face):
    """Corners of a face and what lies on the edges between them."""
    edges = {"tetra10": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
             "hexahedron20": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
             "wedge15": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
             "pyramid13": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4))}.get(kind, ())
    first = 1 + max(max(edge) for edge in edges) if edges else 0
    return [*face, *(first + i for i, edge in enumerate(edges) if set(edge) <= set(face))]


def numbered_faces(mesh, surface, table):
    """Triples (element from 1, face from 1, type) of a surface; elements are numbered block after block."""
    faces = {frozenset(face) for face in mesh.surfaces[surface]}
    number = 0
    for kind, rows in mesh.blocks.items():
        for row in rows:
            number += 1
            for face, corners in enumerate(table[kind.rstrip("0123456789")], 1):
                if frozenset(row[[int(digit) - 1 for digit in corners]]) in faces:
                    yield number, face, kind


def from_gmsh(path):
    """Of a file with one kind of volume elements, named surfaces and points."""
    import meshio
    given = meshio.read(path)
    names = {(int(tag), int(dimension)): name for name, (tag, dimension) in given.field_data.items()}
    mesh = Mesh(given.points, {})
    for cells, tags in zip(given.cells, given.cell_data["gmsh:physical"]):
        dimension = {"vertex": 0, "line": 1, "line3": 1, "triangle": 2, "triangle6": 2, "quad": 2, "quad8": 2}.get(cells.type, 3)
        if dimension == 3:
            mesh.blocks[cells.type] = cells.data
        for tag in np.unique(tags):
            name, own = names.get((int(tag), dimension)), cells.data[tags == tag]
            if name and dimension == 2:
                mesh.surfaces.setdefault(name, []).extend(own[:, :4 if cells.type.startswith("quad") else 3].tolist())
            elif name and dimension == 0:
                mesh.points[name] = [int(node) for node in own.ravel()]
    return mesh


def _lines_of(words, n):
    return [words[i:i + n] for i in range(0, len(words), n)]


ABAQUS_TYPES = {"tetra": "C3D4", "tetra10": "C3D10", "hexahedron": "C3D8I", "hexahedron20": "C3D20R", "wedge": "C3D6",
                "wedge15": "C3D15", "pyramid": "C3D5", "pyramid13": "C3D13"}


def write_inp(mesh, path, node_surfaces=(), head="", tail=""):
    """@param node_surfaces  surfaces told by the set of their nodes instead of by faces."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("*HEADING\nwritten by a test\n" + head + "*NODE, NSET=Nall\n")
        for number, place in enumerate(mesh.nodes, 1):
            file.write(f"{number}, {place[0]:.17g}, {place[1]:.17g}, {place[2]:.17g}\n")
        number = 0
        for kind, rows in mesh.blocks.items():
            file.write(f"*ELEMENT, TYPE={ABAQUS_TYPES[kind]}, ELSET=Eall\n")
            for row in rows:
                number += 1
                words = [str(number), *(str(node + 1) for node in row)]
                file.write(",\n".join(", ".join(part) for part in _lines_of(words, 12)) + "\n")
        for name, nodes in {**mesh.points, **{name: mesh.nodes_of(name) for name in node_surfaces}}.items():
            file.write(f"*NSET, NSET={name}\n")
            for part in _lines_of([str(node + 1) for node in nodes], 16):
                file.write(", ".join(part) + "\n")
        for name in mesh.surfaces:
            if name not in node_surfaces:
                _write_inp_surface(mesh, name, file)
        file.write(tail)


def _write_inp_surface(mesh, name, file):
    by_face = {}
    for number, face, _ in numbered_faces(mesh, name, ABAQUS_FACES):
        by_face.setdefault(face, []).append(str(number))
    for face, numbers in by_face.items():
        file.write(f"*ELSET, ELSET=_{name}_S{face}, INTERNAL\n")
        file.writelines(", ".join(part) + "\n" for part in _lines_of(numbers, 16))
    file.write(f"*SURFACE, TYPE=ELEMENT, NAME={name}\n")
    file.writelines(f"_{name}_S{face}, S{face}\n" for face in by_face)


def write_bdf(mesh, path, held=(), pressed=(), n_modes=None, title="written by a test",
              material="2.1+11          .3      7800."):
    """@param held  surfaces or sets of nodes that become SPC1, from 1. @param pressed  surfaces that become PLOAD4, from 1.
    @param n_modes  that EIGRL asks for. Points become the sets 1, 2, … of the case control."""
    names = {"tetra": "CTETRA", "hexahedron": "CHEXA", "wedge": "CPENTA", "pyramid": "CPYRAM"}
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"SOL 103\nCEND\nTITLE = {title}\n")
        if n_modes:
            file.write("METHOD = 1\nVECTOR(PUNCH)=ALL\n")
        for number, nodes in enumerate(mesh.points.values(), 1):
            file.write(f"SET {number} = {', '.join(str(node + 1) for node in nodes)}\n")
        file.write(f"SUBCASE 1\n  SPC = 1\nBEGIN BULK\n$ comment\nMAT1    1       {material}\n")
        if n_modes:
            file.write(f"EIGRL   {1:8d}{'':16}{n_modes:8d}\n")
        for number, place in enumerate(mesh.nodes, 1):
            x, y, z = (f"{value:16.9E}".replace("E", "D") for value in place)
            file.write(f"GRID*   {number:16d}{'':16}{x}{y}*\n*       {z}\n")
        number = 0
        for kind, rows in mesh.blocks.items():
            for row in rows[:, UPRIGHT_EDGES_FIRST.get(kind, range(rows.shape[1]))]:
                number += 1
                words = [names[kind.rstrip("0123456789")], str(number), "1", *(str(node + 1) for node in row)]
                for i, part in enumerate(_lines_of(words[1:], 8)):
                    file.write(f"{words[0] if i == 0 else '+':8}" + "".join(f"{word:>8}" for word in part) + "\n")
        for number, name in enumerate(held, 1):
            words = [str(node + 1) for node in mesh.points.get(name) or mesh.nodes_of(name)]
            file.write(f"SPC1,{number},123," + ",".join(words[:6]) + "\n")
            file.writelines("+," + ",".join(part) + "\n" for part in _lines_of(words[6:], 8))
        for number, name in enumerate(pressed, 1):
            file.writelines(_pressures(mesh, name, number))
        file.write("ENDDATA\n")


def _pressures(mesh, name, number):
    """The manual: G1 is a corner on the face, G34 the opposite one; of a tetrahedron the corner that is not on it."""
    rows = [row for rows in mesh.blocks.values() for row in rows]
    for element, face, kind in numbered_faces(mesh, name, ABAQUS_FACES):
        corners = [int(digit) - 1 for digit in ABAQUS_FACES[kind.rstrip("0123456789")][face - 1]]
        on = rows[element - 1][corners] + 1
        other = rows[element - 1][({0, 1, 2, 3} - set(corners)).pop()] + 1 if kind.startswith("tetra") else \
            on[2] if len(on) == 4 else ""
        yield f"PLOAD4,{number},{element},1.0,,,,{on[0]},{other}\n"


def write_unv(mesh, path, millimetres=False):
    numbers = {"tetra": 111, "tetra10": 118, "hexahedron": 115, "hexahedron20": 116, "wedge": 112, "wedge15": 113}
    with open(path, "w", encoding="utf-8") as file:
        if millimetres:
            file.write("    -1\n   164\n         5mm (newton)                  2\n"
                       "  1.00000000000000000D+03  1.00000000000000000D+00  1.00000000000000000D+00\n"
                       "  2.73149999999999980D+02\n    -1\n")
        file.write("    -1\n  2411\n")
        for number, place in enumerate(mesh.nodes, 1):
            file.write(f"{number:10d}{1:10d}{1:10d}{11:10d}\n"
                       + "".join(f"{value:25.16E}" for value in place).replace("E", "D") + "\n")
        file.write("    -1\n    -1\n  2412\n")
        number = 0
        for kind, rows in mesh.blocks.items():
            for row in rows[:, RING_BY_RING.get(kind, range(rows.shape[1]))]:
                number += 1
                file.write("".join(f"{word:10d}" for word in (number, numbers[kind], 1, 1, 7, len(row))) + "\n")
                file.writelines("".join(f"{node + 1:10d}" for node in part) + "\n" for part in _lines_of(list(row), 8))
        file.write("    -1\n    -1\n  2467\n")
        groups = {**mesh.points, **{name: mesh.nodes_of(name) for name in mesh.surfaces}}
        for number, (name, nodes) in enumerate(groups.items(), 1):
            file.write("".join(f"{word:10d}" for word in (number, 0, 0, 0, 0, 0, 0, len(nodes))) + f"\n{name}\n")
            members = [word for node in nodes for word in (7, node + 1, 0, 0)]
            file.writelines("".join(f"{word:10d}" for word in part) + "\n" for part in _lines_of(members, 8))
        file.write("    -1\n")


def write_med(mesh, path):
    """Families as Salome makes them: one for each combination of groups."""
    import meshio
    groups = {**mesh.points, **{name: mesh.nodes_of(name) for name in mesh.surfaces}}
    members = [tuple(sorted(name for name, nodes in groups.items() if node in nodes)) for node in range(len(mesh.nodes))]
    families = {names: number for number, names in enumerate(sorted(set(members) - {()}), 1)}
    cells = [(kind, rows[:, MED[kind]]) for kind, rows in mesh.blocks.items()]
    given = meshio.Mesh(mesh.nodes, cells,
                        point_data={"point_tags": np.array([families.get(names, 0) for names in members])})
    given.point_tags = {number: list(names) for names, number in families.items()}
    given.cell_tags = {}
    meshio.write(path, given, "med")


def add_med_modes(path, name, frequencies, shapes, compression=None):
    """A field of displacements in a .med file as IMPR_RESU of Code_Aster writes that of a MODE_MECA: a step for each mode,
    its time the frequency; values component after component."""
    import h5py
    with h5py.File(path, "r+") as file:
        field = file.require_group("CHA").create_group(name)
        words = "".join(f"{word:16}" for word in ("DX", "DY", "DZ"))
        for key, value in (("MAI", next(iter(file["ENS_MAA"]))), ("NOM", words), ("UNI", " " * 48), ("UNT", " " * 16)):
            field.attrs[key] = np.bytes_(value)
        field.attrs["NCO"], field.attrs["TYP"] = 3, 6
        for number, (frequency, shape) in enumerate(zip(frequencies, shapes), 1):
            step = field.create_group(f"{number:020d}{-1:020d}")
            for key, value in (("NDT", number), ("NOR", -1), ("PDT", float(frequency)), ("RDT", -1), ("ROR", -1)):
                step.attrs[key] = value
            nodes = step.create_group("NOE")
            nodes.attrs["GAU"], nodes.attrs["PFL"] = np.bytes_(""), np.bytes_("MED_NO_PROFILE_INTERNAL")
            profile = nodes.create_group("MED_NO_PROFILE_INTERNAL")
            profile.attrs["NBR"], profile.attrs["NGA"] = len(shape), 1
            profile.create_dataset("CO", data=np.asarray(shape, dtype=float).T.ravel(), compression=compression)


def write_punch(path, frequencies, shapes, nodes=None, title="WRITTEN BY A TEST", with_scalar_point=True):
    """Real eigenvectors as Nastran punches them; node numbers from 1 in the order of the shapes, or as given."""
    lines = []
    for mode, (frequency, shape) in enumerate(zip(frequencies, shapes), 1):
        lines += [f"$TITLE   = {title}", "$SUBTITLE=", "$LABEL   =", "$EIGENVECTOR", "$REAL OUTPUT",
                  f"$SUBCASE ID ={1:12d}", f"$EIGENVALUE ={(2 * np.pi * frequency) ** 2:15.7E}  MODE ={mode:6d}"]
        for node, u in zip(nodes if nodes is not None else range(1, len(shape) + 1), shape):
            lines += [f"{node:10d}       G" + "".join(f"{value:18.6E}" for value in u),
                      f"{'-CONT-':18}" + "".join(f"{0.0:18.6E}" for _ in range(3))]
        if with_scalar_point:
            lines += [f"{90000:10d}       S" + "".join(f"{value:18.6E}" for value in (1.0, 0.0, 0.0)),
                      f"{'-CONT-':18}" + "".join(f"{0.0:18.6E}" for _ in range(3))]
    with open(path, "w", encoding="ascii") as file:
        file.writelines(f"{line:72}{number:8d}\n" for number, line in enumerate(lines, 1))


def write_vtk(mesh, path):
    """.vtu or .vtk, by the ending; an array of 0 and 1 for every name."""
    import meshio
    groups = {**mesh.points, **{name: mesh.nodes_of(name) for name in mesh.surfaces}}
    data = {name: np.isin(np.arange(len(mesh.nodes)), nodes).astype(np.int64) for name, nodes in groups.items()}
    meshio.write(path, meshio.Mesh(mesh.nodes, list(mesh.blocks.items()), point_data=data))


def write_exodus(mesh, path):
    import netCDF4
    names = {"tetra": "TETRA4", "tetra10": "TET10", "hexahedron": "HEX8", "hexahedron20": "HEX20", "wedge": "WEDGE",
             "wedge15": "WEDGE15", "pyramid": "PYRAMID5", "pyramid13": "PYRAMID13"}
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as file:
        def put(name, values, *dimensions, kind="i4"):
            for dimension, size in zip(dimensions, np.shape(values)):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, size)
            variable = file.createVariable(name, kind, dimensions)
            variable[:] = values
            return variable

        def put_names(name, words, dimension):
            put(name, np.array([list(word.ljust(33, "\0")) for word in words], dtype="S1"), dimension, "len_name", kind="S1")

        file.createDimension("num_dim", 3)
        for axis, values in zip("xyz", mesh.nodes.T):
            put(f"coord{axis}", values, "num_nodes", kind="f8")
        put("eb_prop1", list(range(1, len(mesh.blocks) + 1)), "num_el_blk")
        for i, (kind, rows) in enumerate(mesh.blocks.items(), 1):
            rows = rows[:, UPRIGHT_EDGES_FIRST.get(kind, range(rows.shape[1]))]
            put(f"connect{i}", rows + 1, f"num_el_in_blk{i}", f"num_nod_per_el{i}").elem_type = names[kind]
        put_names("ns_names", mesh.points, "num_node_sets")
        for i, nodes in enumerate(mesh.points.values(), 1):
            put(f"node_ns{i}", np.array(nodes) + 1, f"num_nod_ns{i}")
        put_names("ss_names", mesh.surfaces, "num_side_sets")
        for i, name in enumerate(mesh.surfaces, 1):
            sides = np.array([(number, face) for number, face, _ in numbered_faces(mesh, name, EXODUS_FACES)])
            put(f"elem_ss{i}", sides[:, 0], f"num_side_ss{i}")
            put(f"side_ss{i}", sides[:, 1], f"num_side_ss{i}")


REFERENCE = types.MappingProxyType({
    "tetra": ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "hexahedron": ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)),
    "wedge": ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)),
    "pyramid": ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1))})
EDGES = types.MappingProxyType({
    "tetra10": ("01", "12", "20", "03", "13", "23"),
    "hexahedron20": ("01", "12", "23", "30", "45", "56", "67", "74", "04", "15", "26", "37"),
    "wedge15": ("01", "12", "20", "34", "45", "53", "03", "14", "25"),
    "pyramid13": ("01", "12", "23", "30", "04", "14", "24", "34")})


def curved_element(kind):
    """One element whose edges are curved: x ↦ x + 0.05 (y², z², x²); "bottom" is its first face, "tip" its last corner."""
    corners = np.array(REFERENCE[kind.rstrip("0123456789")], dtype=float)
    middles = [(corners[int(a)] + corners[int(b)]) / 2 for a, b in EDGES.get(kind, ())]
    nodes = np.vstack([corners, *middles]) if middles else corners
    nodes = nodes + 0.05 * nodes[:, [1, 2, 0]] ** 2
    bottom = [int(digit) - 1 for digit in ABAQUS_FACES[kind.rstrip("0123456789")][0]]
    return Mesh(nodes, {kind: np.arange(len(nodes))[None, :]}, {"bottom": [bottom]}, {"tip": [len(corners) - 1]})
