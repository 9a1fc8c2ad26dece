"""What meshio reads as it should: MED of Salome and Code_Aster (.med), VTK (.vtu, .vtk). Names are ours to find."""

from __future__ import annotations

import contextlib
import io
import re
from typing import TYPE_CHECKING, Iterator, Mapping, Optional, Sequence

import numpy as np

from .content import TYPES, Block, Content, Refused, counted, require
from .decks import text_of

if TYPE_CHECKING:
    import h5py
    import meshio

_MOST_VALUES = 200  # of an array of whole numbers that tells sets; with more it numbers things


def read_med(path: str) -> Content:
    """A Content. Families become groups: a family of nodes or elements is in each group it names."""
    import h5py
    import meshio
    require(h5py.is_hdf5(path), f"{path}: no MED file: it is not HDF5, or it is cut off; files of MED before version 3 must "
                                "be converted")
    _require_known_types(path)
    meshio.med._med._read_families = _groups_of_families
    content, mesh = _read(path, "med")
    content.node_sets = dict(_families(path, "nodes", getattr(mesh, "point_tags", {}), mesh.point_data.get("point_tags"),
                                       content.node_numbers))
    tags = mesh.cell_data.get("cell_tags")
    if tags is not None:
        elements = np.concatenate([block.numbers for block in content.blocks])
        content.element_sets = dict(_families(path, "elements", mesh.cell_tags, np.concatenate(tags), elements))
    content.length_unit = _med_unit(path)
    return content


def _require_known_types(path: str) -> None:
    """meshio ends on others with their name alone."""
    import h5py
    from meshio.med._med import med_to_meshio_type
    try:
        with h5py.File(path, "r") as file:
            found = {kind for mesh in file.get("ENS_MAA", {}).values() for step in mesh.values() for kind in step.get("MAI", ())}
    except (OSError, AttributeError):
        return  # a damaged file: meshio says how
    unknown = sorted(found - set(med_to_meshio_type))
    require(not unknown, f"{path}: elements of type {', '.join(unknown)} are not read; bodies may be TE4, T10, HE8, H20, PE6, P15, PY5, P13")


def _families(path: str, kind: str, groups_of: Mapping[int, Sequence[str]], tags: Optional[np.ndarray],
              numbers: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Pairs (group, its numbers)."""
    unknown = np.setdiff1d(tags if tags is not None else [], [0, *groups_of])
    require(not len(unknown), f"{path}: {kind} are in family {next(iter(unknown), None)}, which is not there, so that groups may lack "
                              "them: is the file damaged? Write it once more")
    names = {name for groups in groups_of.values() for name in groups if name}
    for name in sorted(names) if tags is not None else ():
        yield name, numbers[np.isin(tags, [family for family, groups in groups_of.items() if name in groups])]


def _groups_of_families(families: h5py.Group) -> dict[int, list[str]]:
    """In place of meshio's, which ends on a family that is in no group."""
    return {family.attrs["NUM"]: [text_of(np.asarray(name, dtype="i1").tobytes()).strip().rstrip("\x00") for name in family["GRO"]["NOM"][()]] if "GRO" in family
            else [] for family in families.values()}


def _med_unit(path: str) -> Optional[float]:
    """Metres, where the file names a unit of its coordinates that we know."""
    import h5py
    with h5py.File(path, "r") as file:
        mesh = next(iter(file["ENS_MAA"].values()))
        unit = mesh.attrs.get("UNI", b"")
    words = (unit.decode("latin-1") if isinstance(unit, bytes) else str(unit)).replace("\\0", " ").split()
    return {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "in": 0.0254}.get(words[0].lower()) if words else None


def read_vtk(path: str) -> Content:
    """A Content. An array of whole numbers names a set for each of its values: "material 3", and just "held" for an
    array of 0 and 1."""
    _refuse_pieces(path)
    _refuse_arrays_of_one_name(path)
    content, mesh = _read(path, "vtu" if path.lower().endswith(".vtu") else "vtk")
    for name, values in mesh.point_data.items():
        content.node_sets.update(_valued_sets(name, values, content.node_numbers))
    elements = np.concatenate([block.numbers for block in content.blocks])
    for name, values in mesh.cell_data.items():
        content.element_sets.update(_valued_sets(name, np.concatenate(values), elements))
    return content


def _refuse_pieces(path: str) -> None:
    """Of several meshio keeps the elements of the last."""
    with open(path, "rb") as file:
        n_pieces = len(re.findall(rb"<Piece\b", file.read().split(b"<AppendedData", 1)[0]))
    require(n_pieces < 2, f"{path}: the mesh is in {n_pieces} pieces; make one of them, with one node where they meet (ParaView: Clean "
                          "to Grid), and write it once more")


def _refuse_arrays_of_one_name(path: str) -> None:
    """Of two the later one would take the place of the other."""
    with open(path, "rb") as file:
        text = file.read()
    if path.lower().endswith(".vtu"):
        parts = [found[2] for found in re.finditer(rb"<(PointData|CellData)\b[^>]*(?<!/)>(.*?)</\1>", text, re.S)]
        array = re.compile(rb"""<DataArray\b[^>]*?\bName\s*=\s*(?:"([^"]*)"|'([^']*)')""")
    else:
        parts = re.split(rb"^(?:POINT|CELL)_DATA\b", text, flags=re.M)[1:]
        array = re.compile(rb"^(?:SCALARS\s+(\S+)\s+[a-z]\w*|(\S+)\s+\d+\s+\d+\s+[a-z]\w*\s*$)", re.M)
    for part in parts:
        names = [b"".join(filter(None, found.groups())) for found in array.finditer(part)]
        for name in names:
            require(names.count(name) == 1, f'{path}: two arrays are named "{text_of(name)}"; rename one')


def _valued_sets(name: str, values: np.ndarray, numbers: np.ndarray) -> dict[str, np.ndarray]:
    values = np.asarray(values)
    if values.shape[1:] == (1,):
        values = values[:, 0]
    if values.ndim != 1 or not np.issubdtype(values.dtype, np.integer):
        return {}
    found = np.unique(values)
    if len(found) > _MOST_VALUES or len(found) == len(values) > 1:
        return {}
    if found.tolist() in ([0, 1], [1]):
        return {name: numbers[values == 1]}
    return {f"{name} {value}": numbers[values == value] for value in found if value != 0}


def _read(path: str, file_format: str) -> tuple[Content, meshio.Mesh]:
    import meshio
    said = io.StringIO()
    # Without these meshio 5.0 ends on elements that it knows how to read.
    meshio._mesh.topological_dimension.update(wedge15=3, pyramid13=3)
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):  # where it warns
            mesh = getattr(meshio, file_format).read(path)
    except (MemoryError, ImportError):
        raise
    except (SystemExit, Exception) as error:  # it may leave by either
        raise Refused(f"{path}: no {file_format} file that meshio can read: {_told(error, said)}. It may be cut off or damaged, "
                      "or of another format: write it once more, or as .inp") from error
    dropped = re.search(r"cannot handle \(type (\d+)\)", said.getvalue())  # meshio goes on without them
    require(not dropped, f"{path}: elements of VTK's type {dropped and dropped[1]} are not read; bodies may be 10, 24 (tetrahedra), "
                         "12, 25 (bricks), 13, 26 (wedges), 14, 27 (pyramids)")
    content = Content(np.arange(1, len(mesh.points) + 1), np.asarray(mesh.points, dtype=float), [],
                      either_hand=True)
    require(content.coordinates.ndim == 2 and content.coordinates.shape[1] == 3,
            f"{path}: the mesh is not three-dimensional")
    first = 1
    for cells in mesh.cells:
        told = counted(len(cells.data), f"element of type {cells.type} is", f"elements of type {cells.type} are")
        require(cells.type in TYPES,
                f"{path}: {told} not read; bodies may be {', '.join(name for name, own in TYPES.items() if own.dimension == 3)}")
        content.blocks.append(Block(cells.type, np.arange(first, first + len(cells.data)),
                                    np.asarray(cells.data, dtype=np.int64) + 1))
        first += len(cells.data)
    require(content.blocks, f"{path}: there are no elements in it")
    return content, mesh


def _told(error: BaseException, said: io.StringIO) -> str:
    own_words = not isinstance(error, (SystemExit, AttributeError, TypeError))  # else those of a programmer
    text = " ".join(f"{said.getvalue()} {error if own_words else ''}".split())
    return text.rstrip(".") or f"it ended where more was expected ({type(error).__name__})"
