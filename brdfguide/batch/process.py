"""What this process may take, and has taken, where the system can say so."""

import sys
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from ..errors import InputError

LIMITS: Any = import_module("resource") if find_spec("resource") else None  # POSIX has it


def check_limits() -> None:
    """Raises InputError where no limit can be set."""
    if LIMITS is None:
        raise InputError("--memory: this system sets no limit to a process; leave it out")


def limit_data(mb: float) -> None:
    """From now on this process gets no more data than that, the program's own included; what asks for more fails."""
    hard = LIMITS.getrlimit(LIMITS.RLIMIT_DATA)[1]
    most = int(min(mb * 2**20, 2**62 if hard == LIMITS.RLIM_INFINITY else hard))
    LIMITS.setrlimit(LIMITS.RLIMIT_DATA, (most, most))


def peak_mb() -> float:
    """The most memory that this process had; 0 where nobody knows."""
    if LIMITS is None:
        return 0.0
    peak = LIMITS.getrusage(LIMITS.RUSAGE_SELF).ru_maxrss
    return round(peak / (2**20 if sys.platform == "darwin" else 2**10), 1)
