"""The results of a run, read from its folder when they are asked for: what is damaged costs what lies in it alone."""
from __future__ import annotations

import functools
import os
import tomllib
import warnings
from typing import TYPE_CHECKING, Any, Callable, Iterator, Mapping, Optional, TypeVar

import numpy as np

from microslip.energy import energies
from microslip.files import AGAIN, RunError, data_file, is_held, read_summary, read_table, shown
from microslip.program import Path
from microslip.tables import Table, package, table_of

if TYPE_CHECKING:
    import meshio
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

T = TypeVar("T")
NO_FIGURES = "curves, peaks, budget and maps are there as NumPy arrays and in report.html"


class RunWarning(UserWarning):
    """A run that can be read, but is not what a complete one is."""


class Parts(Mapping[str, T]):
    """Parts of a run by name, each read when it is first asked for."""

    def __init__(self, what: str, names: list[str], read: Callable[[str], T]) -> None:
        self._what, self._names, self._read = what, names, read
        self._known: dict[str, T] = {}

    def __getitem__(self, name: str) -> T:
        if name not in self._names:
            raise KeyError(f"{name}: no such {self._what}; there are {', '.join(self._names) or 'none'}")
        if name not in self._known:
            self._known[name] = self._read(name)
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:
        return f"<{len(self)} {self._what}s: {', '.join(self._names)}>"


class Curve(Table):
    """A response curve: the columns of curves/NAME.csv (share/doc/columns.md), one row per solution, in the order in
    which the branch is walked. `summary` is its entry of summary.json, with `bar`, the error bar of the peak."""

    def __init__(self, run: Run, summary: Mapping[str, Any]) -> None:
        path = os.path.join(run.folder, "curves", summary["name"] + ".csv")
        super().__init__(read_table(path, ("frequency_Hz", "amplitude_m", "stable", "mark")))
        if self.n_rows < summary["points"] and run.is_running:
            raise RunError(f"{shown(path)}: written anew since the folder was opened; open it again")
        if self.n_rows < summary["points"]:
            raise RunError(f"{shown(path)}: {self.n_rows} rows, summary.json counts {summary['points']} points: {AGAIN}")
        self.run, self.summary, self.name = run, summary, summary["name"]

    @property
    def preload(self) -> Any:
        """Total normal force [N], or "free" or "stuck"; the factor where the scene scales its preloads."""
        scale = self.summary.get("preload_scale")
        return self.summary.get("preload_N") if scale is None else scale

    @property
    def peak(self) -> Optional[dict[str, float]]:
        """The highest peak: frequency_Hz and amplitude_m. None where there is none."""
        return self.summary.get("peak")

    @property
    def largest(self) -> Optional[dict[str, Any]]:
        """The highest peak, `at` "peak"; of a complete curve without one its highest point, `at` "range_end"."""
        return self.summary.get("largest")

    @property
    def peaks(self) -> Table:
        """The rows that were solved for as peaks."""
        return self.rows(np.array(self["mark"]) == "peak")

    @property
    def folds(self) -> Table:
        return self.rows(np.array(self["mark"]) == "fold")

    @functools.cached_property
    def energy(self) -> Table:
        """Per row: `dissipated_energy_J` by friction in one period, and `equivalent_damping_ratio` of friction and
        modal damping together (microslip.energy). RunError where model.h5 or the states of the curve are not there."""
        return Table(energies(self.run.folder, self.name))

    def plot(self, axes: Optional[Axes] = None) -> Axes:
        """Draws the curve into `axes`, or a new figure; amplitudes in the unit of run.plot_curves()."""
        package("matplotlib", NO_FIGURES)
        from microslip.plots.figures import draw_one_curve
        return draw_one_curve(self.run.folder, self.name, axes)


class ContactMap(Table):
    """A contact map over one period: arrays of maps/NAME.h5 (share/doc/columns.md). n points at m phases: `points`
    (n × 2) along p and r [m], `phase_deg` (m), `state` and tractions (n × m), sums over the period (n)."""

    def __init__(self, run: Run, name: str) -> None:
        self.run, self.name = run, name
        with data_file(os.path.join(run.folder, "maps", name + ".h5")) as file:
            super().__init__({key: values[:] for key, values in file.items()})

    def __repr__(self) -> str:
        return f"<ContactMap {self.name}: {len(self['points'])} points at {len(self['phase_deg'])} phases>"

    @functools.cached_property
    def wide(self) -> list[str]:
        """Names of the arrays that vary over the period."""
        shape = (len(self["points"]), len(self["phase_deg"]))
        return [name for name, values in self.items() if values.shape == shape and not name.startswith("vertex_")]

    def dataset(self) -> xarray.Dataset:
        """Over `point` and `phase_deg`, p and r as coordinates of the points. MissingPackage without xarray."""
        xarray = package("xarray", "arrays are NumPy's: contact_map[\"state\"]")
        n = len(self["points"])
        arrays: dict[str, Any] = {name: (("point", "phase_deg"), self[name]) for name in self.wide}
        arrays.update({name: (("point",), values) for name, values in self.items() if values.shape == (n,) and n > 1})
        return xarray.Dataset(arrays, coords={"phase_deg": self["phase_deg"], "p": ("point", self["points"][:, 0]),
                                              "r": ("point", self["points"][:, 1])})

    def mesh(self, phase_deg: float = 0.0) -> meshio.Mesh:
        """The cells of the patch in the plane of p and r [m], with the arrays at the phase nearest to one [deg] and
        the sums over the period as cell data. RunError where the points have no cells, MissingPackage without meshio."""
        meshio = package("meshio", "arrays are NumPy's: contact_map[\"state\"]")
        cells = self["cells"]
        if not len(cells):
            raise RunError(f"{self.name}: its points have no cells; contact_map[\"points\"] says where they are")
        phase = int(np.argmin(np.abs((self["phase_deg"] - phase_deg + 180) % 360 - 180)))
        data = {name: [self[name][:, phase]] for name in self.wide}
        data.update({name: [values] for name, values in self.items() if values.shape == (len(cells),)})
        corners = np.column_stack([self["vertices"], np.zeros(len(self["vertices"]))])
        kind = "triangle" if cells.shape[1] == 3 else "quad"
        return meshio.Mesh(corners, [(kind, cells)], cell_data=data)

    def plot(self) -> Figure:
        """The figure of the report: states at four phases, dissipated energy, slip distance."""
        return self.run.plot_map(self.name)


class Modes(Table):
    """Natural frequencies: the columns of modes.csv."""

    def __init__(self, run: Run) -> None:
        self.run = run
        super().__init__(table_of(run.summary.get("modes") or []))

    def mesh(self) -> meshio.Mesh:
        """The structure with its shapes, point data mode_1 … mode_N (n_nodes × 3, 1/√kg). RunError for a scene without
        a mesh, MissingPackage without meshio. pyvista.from_meshio() takes it."""
        meshio = package("meshio", "frequencies are there: run.modes[\"frequency_Hz\"]")
        path = os.path.join(self.run.folder, "modes.vtu")
        if not os.path.exists(path):
            raise RunError(f"{shown(path)} is missing: only scenes with a mesh have shapes to show")
        try:
            return meshio.read(path)
        except Exception as error:  # whatever the reader makes of a damaged file
            raise RunError(f"{shown(path)}: cannot be read: {error}: {AGAIN}") from None


class Run:
    """The folder of a run. `summary` is its summary.json, `exit_code` 0 where every curve is complete; `is_running` tells that it was
    still being written when it was opened: what was finished by then is there."""

    def __init__(self, folder: Path, summary: Optional[Path] = None) -> None:
        """summary: file to read in place of that in the folder."""
        self.folder = os.path.abspath(os.fspath(folder))
        self.is_running = is_held(self.folder)  # before its summary: a run that ends in between has written the whole
        self.summary = read_summary(os.fspath(summary or os.path.join(self.folder, "summary.json")))
        entries = {curve["name"]: curve for curve in self.summary["curves"] if curve["points"] > 0}
        self.curves: Parts[Curve] = Parts("curve", list(entries), lambda name: Curve(self, entries[name]))
        names = [name for curve in self.summary["curves"] for name in curve.get("maps") or []]
        self.maps: Parts[ContactMap] = Parts("map", names, lambda name: ContactMap(self, name))
        self.title: str = self.summary.get("title", "")
        self.exit_code: int = self.summary.get("exit_code", 0)
        if self.message:
            warnings.warn(f"{self.folder}: {self.message}", RunWarning, stacklevel=2)

    def __repr__(self) -> str:
        still = ", still being written" if self.is_running else ""
        return f"<Run {self.folder}: {len(self.curves)} curves, {len(self.maps)} maps{still}>"

    @property
    def message(self) -> str:
        """Why the run has not come to its end; empty where it has."""
        if self.is_running and self.exit_code == 3:
            there = "1 curve is" if len(self.curves) == 1 else f"{len(self.curves)} curves are"
            return f"the run is still being written: {there} there so far; open the folder again for more"
        return self.summary.get("message") or ""

    @property
    def warnings(self) -> list[str]:
        return list(self.summary.get("warnings") or [])

    @functools.cached_property
    def scene(self) -> dict[str, Any]:
        """The scene as it was solved, every default written out."""
        path = os.path.join(self.folder, "scene.toml")
        try:
            with open(path, "rb") as file:
                return tomllib.load(file)
        except FileNotFoundError:
            raise RunError(f"{shown(path)} is missing; run the scene again") from None
        except (OSError, ValueError) as error:
            raise RunError(f"{shown(path)}: {error}: {AGAIN}") from None

    @functools.cached_property
    def modes(self) -> Modes:
        return Modes(self)

    @property
    def peaks(self) -> Table:
        """The highest peak of every curve: curve, preload_N (NaN for the limits), preload, frequency_Hz, amplitude_m,
        dissipated_energy_J (by friction in a period), and the relative half widths amplitude_bar, frequency_bar,
        energy_bar; NaN where there is none: of the energy also where friction dissipates nothing."""
        return table_of([peak_row(entry) for entry in self.summary["curves"] if entry["points"] > 0])

    @property
    def optimum(self) -> Optional[dict[str, Any]]:
        """The best value of the search, as summary.json has it; None where none was asked for."""
        return self.summary.get("optimum")

    @property
    def budget(self) -> Table:
        """The error budget, one row per curve, goal and source; `effect` is signed and relative."""
        return table_of(self.summary.get("error_budget") or [])

    def frame(self) -> Any:
        """`peaks` as pandas has it."""
        return self.peaks.frame()

    def _figure(self, name: str, lacking: str) -> Figure:
        package("matplotlib", NO_FIGURES)
        from microslip.plots.figures import figure_of_run
        return figure_of_run(self.folder, name, lacking)

    def plot_curves(self) -> Figure:
        """plots/curves.png of the report as a matplotlib figure: draw into figure.axes, or figure.savefig(FILE)."""
        return self._figure("curves", "no finished curve of more than one frequency: there is none to draw")

    def plot_peaks(self) -> Figure:
        """Peak against preload. RunError with less than two peaks."""
        return self._figure("peak_against_preload", "less than two curves have a peak")

    def plot_parameter(self) -> Figure:
        """Peak against the number a search for a best value varied. RunError without such a search."""
        return self._figure("peak_against_parameter", "no search has varied a number beside the preload")

    def plot_error_budget(self) -> Figure:
        """RunError without an error budget."""
        return self._figure("error_budget", "no error budget; [accuracy] error_budget = \"auto\" makes one")

    def plot_map(self, name: Optional[str] = None) -> Figure:
        """A contact map, the first by default. RunError without maps."""
        package("matplotlib", NO_FIGURES)
        from microslip.plots.figures import figure_of_map
        return figure_of_map(self.folder, name)


def peak_row(entry: Mapping[str, Any]) -> dict[str, Any]:
    """The highest peak of a curve, with its bar."""
    peak, bar, preload = entry.get("peak") or {}, entry.get("bar") or {}, entry.get("preload_N")
    return {"curve": entry["name"], "preload": preload, "preload_N": None if isinstance(preload, str) else preload,
            "frequency_Hz": peak.get("frequency_Hz"), "amplitude_m": peak.get("amplitude_m"),
            "amplitude_bar": bar.get("peak_amplitude"), "frequency_bar": bar.get("peak_frequency"),
            "dissipated_energy_J": peak.get("dissipated_energy_J"), "energy_bar": bar.get("dissipated_energy")}
