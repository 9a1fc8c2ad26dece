"""Columns of numbers with names: NumPy first, pandas and xarray where they are there."""
from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Sequence, Union

import numpy as np

if TYPE_CHECKING:
    import pandas
    import xarray

Column = Union[np.ndarray, Sequence[str]]
DEBIAN = {"matplotlib": "python3-matplotlib", "pandas": "python3-pandas", "xarray": "python3-xarray",
          "meshio": "python3-meshio", "h5py": "python3-h5py"}


class MissingPackage(ImportError):
    """An optional Python package is not installed. The message names it, and what works without."""


def package(name: str, instead: str) -> Any:
    """An optional package. MissingPackage where it is not installed; `instead` tells what works without it."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != name.partition(".")[0]:
            raise
        needed = name.partition(".")[0]
        raise MissingPackage(f"the Python package {needed} is not installed (pip install {needed}, or apt-get install "
                             f"{DEBIAN[needed]}); without it {instead}", name=needed) from None


class Table(Mapping[str, Any]):
    """Columns of equal length by name: table["frequency_Hz"] is a NumPy array; of texts a list."""

    def __init__(self, columns: Mapping[str, Column]) -> None:
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> Any:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"{name}: no such column; there are {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def n_rows(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.n_rows} rows of {', '.join(self._columns)}>"

    def rows(self, chosen: np.ndarray) -> Table:
        """The rows a mask or a list of numbers chooses."""
        numbers = np.arange(self.n_rows)[chosen]
        return Table({name: column[numbers] if isinstance(column, np.ndarray) else [column[i] for i in numbers]
                      for name, column in self.items()})

    def frame(self) -> pandas.DataFrame:
        """As pandas has it. MissingPackage without pandas."""
        pandas = package("pandas", "columns are NumPy arrays: table[\"frequency_Hz\"]")
        return pandas.DataFrame(self._columns)

    def dataset(self) -> xarray.Dataset:
        """As xarray has it, over the number of the row. MissingPackage without xarray."""
        xarray = package("xarray", "columns are NumPy arrays: table[\"frequency_Hz\"]")
        return xarray.Dataset({name: ("row", np.asarray(column)) for name, column in self.items()})


def table_of(rows: Sequence[Mapping[str, Any]]) -> Table:
    """Rows of a JSON file as columns; a number that is missing is NaN."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    return Table({name: column_of([row.get(name) for row in rows]) for name in names})


def column_of(values: list[Any]) -> Column:
    """Numbers as an array, anything else as it is."""
    if all(value is None or isinstance(value, (int, float)) for value in values):
        return np.array([np.nan if value is None else value for value in values], dtype=float)
    return values
