"""Touches all that is read of an HDF5 file, in a process of its own: `python _hdf5_trial.py FILE`, or - for stdin.

On a damaged file the library may go round for ever, or end the process. Then that is this one: a file that was touched
to the end is safe to read, and one that was not is told by how the process ended.
"""

import io
import signal
import sys

LIMIT_S = 5  # of processor time, for at most MOST values of a dataset
MOST = 8_000_000


def holds_numbers_or_words(kind, h5py) -> bool:
    """Whether values of a type are numbers or words. Damaged ones of other types end the process when they are read."""
    return kind.get_class() in (h5py.h5t.INTEGER, h5py.h5t.FLOAT, h5py.h5t.STRING, h5py.h5t.ENUM)


def touch(file: "io.BufferedIOBase", h5py) -> None:
    """Attributes and values, and of more than MOST values the first row."""

    def each(_, node) -> None:
        for name in node.attrs:
            if holds_numbers_or_words(node.attrs.get_id(name).get_type(), h5py):
                node.attrs[name]
        if isinstance(node, h5py.Dataset) and node.shape and holds_numbers_or_words(node.id.get_type(), h5py):
            node[() if node.size <= MOST else slice(1)]

    root = h5py.File(file, "r")
    each("", root)
    root.visititems(each)


if __name__ == "__main__":
    import h5py

    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, LIMIT_S)
    touch(io.BytesIO(sys.stdin.buffer.read()) if sys.argv[1] == "-" else open(sys.argv[1], "rb"), h5py)  # noqa: SIM115
