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
    if isinstance(error, ModuleNotFoundError) and error.name in PACKAGES:
        package = PACKAGES[error.name]
        return f"{source}: this format needs the Debian package {package}: apt-get install {package}"
    if is_of_the_disk(error):
        return (f"{source}: what it is converted to cannot be written in the temporary folder (TMPDIR): {error.strerror}; check free "
                "space and limits of file size (ulimit -f)")
    if type(error).__name__ == "Refused":
        return str(error)
    return f"{source}: reading it failed: {type(error).__name__}: {' '.join(str(error).split())}"


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
