"""Signals end the program where it stands, by way of every `finally`.

A handler's exception may be lost: C code that asks an object something, and `__del__`, drop whatever is raised inside.
So it is raised again until somebody has heard it.
"""

import signal
from types import FrameType

from .errors import Stopped

SIGNALS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
AGAIN_S = 0.3


def listen() -> None:
    """Signals raise Stopped from now on."""
    for number in SIGNALS:
        if number != getattr(signal, "SIGHUP", None) or signal.getsignal(number) != signal.SIG_IGN:  # nohup
            signal.signal(number, _stop)


def heard() -> None:
    """Whoever catches Stopped says so, and is left in peace."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, 0)


def _stop(number: int, _: FrameType | None) -> None:
    end = Stopped(128 + number)
    if hasattr(signal, "setitimer"):

        def again(*_) -> None:
            raise end

        signal.signal(signal.SIGALRM, again)
        signal.setitimer(signal.ITIMER_REAL, AGAIN_S, AGAIN_S)
    raise end
