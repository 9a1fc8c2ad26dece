"""What the converters of share/scripts have in common: limits, and a sentence for whatever a damaged file does."""
from __future__ import annotations

import errno
import resource
import sys
from typing import Callable

PACKAGES = {"numpy": "python3-numpy", "meshio": "python3-meshio", "h5py": "python3-h5py", "netCDF4": "python3-netcdf4"}


def problem_of(source: str, error: Exception) -> str:
    """A sentence for the user."""
    if isinstance(error, MemoryError):
        return f"{source}: reading it needs more memory than is allowed"
    missing = missing_package(error)
    if missing:
        return f"{source}: this format needs {missing}"
    if is_of_the_disk(error):
        return (f"{source}: what it is converted to cannot be written in the temporary folder (TMPDIR): {error.strerror}; check free "
                "space and limits of file size (ulimit -f)")
    if type(error).__name__ == "Refused":
        return str(error)
    return f"{source}: reading it failed: {type(error).__name__}: {' '.join(str(error).split())}"


def missing_package(error: BaseException) -> str:
    """What to install where a Python module is not there, or is damaged; else nothing. Of a package that was taken away a
    folder may be left, which Python takes for an empty one."""
    empty = [name for name in PACKAGES if name in sys.modules and getattr(sys.modules[name], "__file__", name) is None]
    module = (error.name or "").partition(".")[0] if isinstance(error, ImportError) else ""
    for name in (*empty, module):
        if name in PACKAGES:
            return f"the Debian package {PACKAGES[name]}: apt-get install {PACKAGES[name]}"
    if isinstance(error, ModuleNotFoundError):
        return (f"the Python module {module}, on which {' or '.join(PACKAGES.values())} depends, and {sys.executable} does not find "
                "it: apt-get install --fix-broken, or install them again")
    if isinstance(error, ImportError):
        return (f"{' or '.join(PACKAGES.values())}, of which one cannot be loaded ({first_sentence(error)}): apt-get install --reinstall "
                "it")
    return ""


def first_sentence(error: BaseException) -> str:
    """Of the error that led to others."""
    while error.__cause__ or error.__context__:
        error = error.__cause__ or error.__context__
    return " ".join(str(error).split())[:200]


def is_of_the_disk(error: Exception) -> bool:
    """No fault of the file that is read: what it becomes has no room."""
    return isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


def limit(what: int, value: int) -> None:
    """To a value, or to less where the user's own limit is lower."""
    _, hard = resource.getrlimit(what)
    lower = value if hard == resource.RLIM_INFINITY else min(value, hard)
    resource.setrlimit(what, (lower, lower))


def run(convert: Callable[[str, str, str], object], source: str, output: str, facts: str, seconds: str, megabytes: str) -> int:
    """convert(source, output, facts) within limits of processor time and address space. Returns 0, or after the last line
    of standard error told what is wrong 1, and 4 where that is the disk."""
    limit(resource.RLIMIT_CPU, int(float(seconds)) + 1)
    limit(resource.RLIMIT_AS, int(float(megabytes) * 1e6))
    try:
        convert(source, output, facts)
    except Exception as error:  # whatever a library throws at a damaged file
        print(problem_of(source, error), file=sys.stderr)
        return 4 if is_of_the_disk(error) else 1
    return 0
