"""A run in ParaView: the blade in motion on the left, the contact map beside it, colours and units set, time is the phase.

    paraview --script=open_run.py          the folder of the run in the environment variable MICROSLIP_RUN
    pvbatch open_run.py RUN_FOLDER [NAME [PICTURE.png [PHASE]]]
    as a macro (Macros, Import new macro): the run of the file that is selected in the pipeline

NAME is that of a map or a motion, preload_100_peak; the first of the run where not given. PHASE in
degrees, the nearest there is; 0 where not given. ParaView 5.11.
"""
import glob
import json
import math
import os
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

SHARE_OF_SIZE = 0.1  # to which the largest displacement is drawn
SIZE = [1600, 700]  # of a picture


def folder_of_selected():
    """The run folder of the file that is selected: two above maps/X.pvd, motion/X.pvd."""
    source = simple.GetActiveSource()
    name = getattr(source, "FileName", None) if source else None
    name = name[0] if isinstance(name, (list, tuple)) else name
    return os.path.dirname(os.path.dirname(os.path.abspath(str(name)))) if name else None


def asked():
    """Folder, name, picture and phase [deg], as given; None for what is not, but 0 for the phase."""
    words = [word for word in sys.argv[1:] if not word.startswith("-")]
    folder = words[0] if words else os.environ.get("MICROSLIP_RUN") or folder_of_selected()
    if not folder or not os.path.isdir(folder):
        sys.exit(f"{folder or 'no folder given'}: give the folder of a run: pvbatch open_run.py RUN_FOLDER, or MICROSLIP_RUN, "
                 "or select a file of it in the pipeline")
    name, picture, phase = (words[at] if len(words) > at else None for at in (1, 2, 3))
    try:
        return folder, name, picture, float(phase or 0)
    except ValueError:
        sys.exit(f"{phase}: give the phase in degrees")


def stem(path):
    return os.path.basename(path)[:-len(".pvd")]


def pair_of(folder, name):
    """Motion and map: of the name given, or else of its curve; without a name of a solution that has both, or else of a
    curve. None for what there is not."""
    motions, maps = (sorted(glob.glob(os.path.join(folder, kind, "*.pvd"))) for kind in ("motion", "maps"))
    pairs = [(motion, contact) for contact in maps for motion in motions
             if stem(contact).startswith(stem(motion)[:-len("peak")])]
    pairs.sort(key=lambda pair: not stem(pair[1]).startswith(stem(pair[0])))  # the same solution first
    pairs += [(motion, None) for motion in motions] + [(None, contact) for contact in maps]
    for pair in pairs:
        if name is None or name in (stem(file) for file in pair if file):
            return pair
    sys.exit(f"{folder}: no motion and no contact map{f' of the name {name}' if name else ''}; there are "
             f"{', '.join(dict.fromkeys(map(stem, motions + maps))) or 'none: give the scene [response] maps'}")


def size_of(source):
    low_high = source.GetDataInformation().GetBounds()
    return math.dist(low_high[::2], low_high[1::2])


def annotate(source, file, view):
    """Name and phase, above everything."""
    time = simple.AnnotateTimeFilter(Input=source)
    time.Format = f"{os.path.basename(os.path.dirname(file))} {stem(file)}, phase {{time:.0f}}°"
    shown = simple.Show(time, view)
    shown.FontSize, shown.Color = 12, [0.1, 0.1, 0.1]


def show_motion(file, view):
    """The structure, its displacement enlarged and coloured by its size."""
    source = simple.PVDReader(FileName=file)
    simple.UpdatePipeline(time=source.TimestepValues[0], proxy=source)
    largest = 0.0
    for time in source.TimestepValues:
        source.UpdatePipeline(time)
        low, high = source.PointData["displacement_m"].GetRange(-1)
        largest = max(largest, high)
    warp = simple.WarpByVector(Input=source, Vectors=["POINTS", "displacement_m"])
    warp.ScaleFactor = SHARE_OF_SIZE * size_of(source) / largest if largest > 0 else 1.0
    shown = simple.Show(warp, view)
    simple.ColorBy(shown, ("POINTS", "displacement_m", "Magnitude"))
    shown.Ambient, shown.Diffuse = 0.5, 0.5  # shade, but colours near those of the bar
    table = simple.GetColorTransferFunction("displacement_m")
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.RescaleTransferFunction(0.0, largest or 1.0)
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = "displacement [m]", f"drawn × {warp.ScaleFactor:.3g}"
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.2e", "%.2e"
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    shown.SetScalarBarVisibility(view, True)
    annotate(source, file, view)
    simple.ResetCamera(view)


def colours_of_states():
    """share/paraview/contact_state.json: [value, name, …] and colours in a row."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "contact_state.json")
    with open(path, encoding="utf-8") as file:
        preset = json.load(file)[0]
    return preset["Annotations"], preset["IndexedColors"]


def look_along_normal(source, view):
    """Straight on the patch, its longest side flat: along the axes of its points. Points in a row have no face."""
    points = vtk_to_numpy(servermanager.Fetch(source).GetPoints().GetData())
    if np.linalg.matrix_rank(points - points[0], tol=1e-9) < 2:
        simple.ResetCamera(view)
        return
    centre = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - centre, full_matrices=False)
    long_side, short_side = (axis * np.sign(axis[np.abs(axis).argmax()]) for axis in axes[:2])
    sizes = np.ptp((points - centre) @ axes.T, axis=0)
    view.CameraFocalPoint = list(centre)
    view.CameraPosition = list(centre + 2.0 * sizes[0] * np.cross(long_side, short_side))
    view.CameraViewUp = list(short_side)
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.6 * sizes[0]


def show_map(file, view):
    """The patch, its cells coloured by their state."""
    source = simple.PVDReader(FileName=file)
    simple.UpdatePipeline(time=source.TimestepValues[0], proxy=source)
    shown = simple.Show(source, view)
    where = "CELLS" if "state" in source.CellData.keys() else "POINTS"
    simple.ColorBy(shown, (where, "state"))
    shown.PointSize = 20  # of contacts without cells
    shown.Ambient, shown.Diffuse = 1.0, 0.0  # colours as the legend has them
    table = simple.GetColorTransferFunction("state")
    table.InterpretValuesAsCategories = 1
    table.AnnotationsInitialized = 1
    table.Annotations, table.IndexedColors = colours_of_states()
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = "state", ""
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    shown.SetScalarBarVisibility(view, True)
    annotate(source, file, view)
    look_along_normal(source, view)


def new_view():
    view = simple.CreateView("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    return view


def go_to(phase):
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    phases = np.atleast_1d(scene.TimeKeeper.TimestepValues)
    scene.AnimationTime = phases[np.abs(phases - phase).argmin()]


def open_run(folder, name=None, phase=0.0):
    """Two views side by side, one where the run has one of the two. The layout."""
    motion, contact = pair_of(folder, name)
    layout = simple.CreateLayout("microslip")
    views = []
    for file, show in ((motion, show_motion), (contact, show_map)):
        if file:
            view = new_view()
            simple.AssignViewToLayout(view=view, layout=layout, hint=len(views))
            show(file, view)
            views.append(view)
    go_to(phase)
    simple.RenderAllViews()
    return layout


if __name__ in ("__main__", "__vtkconsole__"):
    run_folder, wanted, picture, instant = asked()
    opened = open_run(run_folder, wanted, instant)
    if picture:
        opened.SetSize(*SIZE)
        simple.SaveScreenshot(picture, opened, ImageResolution=SIZE)
