"""A ZIP of one measurement: read as the file in it. Workbooks and folders of arrays, which are ZIPs too, stay as they
are."""

from contextlib import contextmanager, suppress
from pathlib import PurePosixPath

from ...errors import InputError

BEGINS = b"PK\x03\x04"
OF_A_FORMAT = ("[Content_Types].xml", "mimetype", "zarr.json", ".zgroup", ".zarray", ".zattrs", ".zmetadata")
BESIDE = ("readme", "license", "licence", "copying", "thumbs", "desktop", "notice", "citation")  # stems of other files
SHOWN = 5
MOST_LISTED = 2**26  # bytes of an archive's list of files that is read
LIST_ENDS = b"PK\x05\x06"


@contextmanager
def one_file(raw, name: str):
    """The stream of the only file in a ZIP, and its bytes as packed; of any other file itself, and 0.

    Raises InputError for a ZIP of several files, or of none, and for one that cannot be unpacked.
    """
    entry = _only_entry(raw, name)
    if entry is None:
        yield raw, 0
        return
    archive, info = entry
    if info.flag_bits & 1:
        raise InputError(f"{name}: '{info.filename[:60]}' in it is locked by a password; unpack it and give the file")
    try:
        stream = archive.open(info)
    except Exception as error:  # BadZipFile, NotImplementedError, RuntimeError: each fault has its own
        raise InputError(f"{name}: '{info.filename[:60]}' in it cannot be unpacked: {str(error)[:80]}") from None
    yield _Member(stream, name), max(info.compress_size, 1)


def _only_entry(raw, name: str):
    """The archive and its only file; None for what is no ZIP, and for one that is a format of its own."""
    if not getattr(raw, "seekable", lambda: False)():
        return None
    begins = raw.read(len(BEGINS))
    raw.seek(0)
    if begins != BEGINS or _listed(raw) > MOST_LISTED:
        return None
    from zipfile import BadZipFile, ZipFile

    entries = None
    with suppress(BadZipFile, OSError, ValueError, NotImplementedError, EOFError):
        archive = ZipFile(raw)
        entries = [each for each in archive.infolist() if not each.is_dir()]
    raw.seek(0)
    if entries is None or any(PurePosixPath(each.filename).name in OF_A_FORMAT for each in entries):
        return None
    found = [each for each in entries if _may_be_measured(each.filename)]
    if len(found) == 1:
        return archive, found[0]
    names = ", ".join(each.filename[:40] for each in found[:SHOWN]) + ", ..." * (len(found) > SHOWN)
    there = f"{len(found)} files ({names})" if found else "no file"
    raise InputError(f"{name}: a ZIP archive of {there}; wanted one: unpack it and give the file that is meant")


def _listed(raw) -> int:
    """Bytes of the archive's list of files, as its end says."""
    size = raw.seek(0, 2)
    raw.seek(max(size - 2**16, 0))
    end = raw.read(2**16)
    raw.seek(0)
    place = end.rfind(LIST_ENDS)
    return int.from_bytes(end[place + 12 : place + 16], "little") if place >= 0 else 0


def _may_be_measured(path: str) -> bool:
    parts = PurePosixPath(path).parts
    hidden = any(part.startswith((".", "__MACOSX")) for part in parts)
    return bool(parts) and not hidden and PurePosixPath(path).stem.lower() not in BESIDE


class _Member:
    """read(size) over a file in an archive. Raises InputError where it is damaged."""

    def __init__(self, stream, name: str):
        self.stream, self.name = stream, name

    def read(self, size: int) -> bytes:
        try:
            return self.stream.read(size)
        except Exception as error:  # zlib.error, BadZipFile, EOFError: each library has its own
            raise InputError(f"{self.name}: its ZIP compression is damaged: {str(error)[:80]}") from None
