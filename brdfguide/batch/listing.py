"""Which surfaces are meant: files, folders, patterns, lists; and which of them are this shard's."""

import glob
import hashlib
import os
from collections.abc import Callable, Iterable, Mapping
from fnmatch import fnmatch
from pathlib import Path
from typing import NamedTuple

from .. import opening
from ..errors import InputError
from .store import INDEX, SIGN

MOST_OF_A_LIST = 2**30  # bytes
OWN_FOLDERS = ("answers", "failed", "names", "claims", "events")  # in a folder of answers
OWN_FILES = (SIGN, INDEX)
# What a scheduler of array jobs says of a task: its number, the first number, how many there are, or the last one.
ARRAYS = (
    ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_COUNT", ""),
    ("SGE_TASK_ID", "SGE_TASK_FIRST", "", "SGE_TASK_LAST"),
    ("LSB_JOBINDEX", "", "", "LSB_JOBINDEX_END"),
    ("PBS_ARRAY_INDEX", "", "", ""),
    ("JOB_COMPLETION_INDEX", "0", "", ""),  # Kubernetes; counts from 0, and does not say how many there are
    ("CUE_IFRAME", "", "", ""),  # OpenCue
)


class Shard(NamedTuple):
    """Part `number` of `of`, counted from 0."""

    number: int
    of: int

    def has(self, label: str) -> bool:
        """Whether a name of the list is its own: by the name alone, so that every machine says the same."""
        return int(hashlib.sha256(os.fsencode(label)).hexdigest(), 16) % self.of == self.number


def shard_of(words: str, environment: Mapping[str, str] = os.environ) -> Shard:
    """`I/N`, I from 0 to N - 1; `auto` or `auto/N`: as the scheduler of array jobs says.

    Raises InputError for anything else.
    """
    wanted = "wanted I/N with I from 0 to N-1, such as 0/8, or auto inside an array job"
    part, slash, whole = words.partition("/")
    number, of = _whole_number(part), _whole_number(whole)
    if part == "auto" and (of or not slash):
        return _of_array(words, of, environment)
    if number is None or not of:
        raise InputError(f"--shard {words}: {wanted}")
    if number >= of:
        raise InputError(f"--shard {words}: shards count from 0, the last of {of} is {of - 1}/{of}")
    return Shard(number, of)


def _of_array(words: str, of: int | None, environment: Mapping[str, str]) -> Shard:
    for index, first, count, last in ARRAYS:
        told = _whole_number(environment.get(index))
        if told is None:
            continue
        begin = _whole_number(environment.get(first, first if first.isdecimal() else "1"))
        if begin is None:
            raise InputError(f"--shard {words}: {first} is {environment[first]!r}; wanted a number")
        number = told - begin
        if of is None:
            of = _whole_number(environment.get(count))
        if of is None and (end := _whole_number(environment.get(last))) is not None:
            of = end - begin + 1
        if of is None:
            raise InputError(f"--shard {words}: {index} does not say how many tasks there are; say auto/N")
        if not 0 <= number < of:
            raise InputError(f"--shard {words}: {index} is {environment[index]}, beyond {of} tasks from {begin} on")
        return Shard(number, of)
    known = ", ".join(each[0] for each in ARRAYS)
    raise InputError(f"--shard {words}: this is no task of an array job: none of {known} is set")


def _whole_number(word: str | None) -> int | None:
    return int(word) if word is not None and word.isdecimal() and len(word) < 20 else None


class Listing(NamedTuple):
    """Names as they were listed, and how many files of folders were passed over since nothing here reads them."""

    labels: list[str]
    passed_over: int = 0


def from_list(source: str, null: bool) -> list[str]:
    """The names in a file or, for `-`, on standard input: a line each, or each ended by a zero byte.

    Raises InputError where it cannot be read.
    """
    name = "standard input" if source == "-" else source
    data = opening.standard_input(MOST_OF_A_LIST) if source == "-" else opening.content(source, MOST_OF_A_LIST, name)
    if null and data and b"\0" not in data:
        raise InputError(f"{name}: found no zero byte; without -0 a list has a name on each line")
    return [os.fsdecode(word) for word in data.split(b"\0" if null else b"\n") if word]


def expanded(words: Iterable[str], include: tuple[str, ...], recurse: bool, is_ours: Callable[[Path], bool]) -> Listing:
    """Files for folders and patterns, in the order of their names; other words as they are.

    Takes  include, patterns of names; without one a folder's files are those that `is_ours` by what is in them.
    Raises InputError where nothing is meant but a pattern that nothing matches or a folder without a file; among other
    words such a one stays as it is, and whoever opens it says what is wrong.
    """
    words, labels, passed_over = list(words), [], 0
    for word in words:
        found, why = [word], ""
        if opening.is_folder(word):
            found, others = _of_folder(Path(word), include, recurse, is_ours)
            passed_over += others
            what = f"no file like {' or '.join(include)}" if include else "no file of a format that can be read"
            why = f"found {what}" + ("" if recurse else "; --recurse looks into its folders too")
        elif not opening.exists(word) and glob.has_magic(word):
            found = sorted(each for each in glob.glob(word, recursive=True) if not opening.is_folder(each))
            why = "no file has such a name"
        if not found and len(words) == 1:
            raise InputError(f"{word}: {why}")
        labels += found or [word]
    return Listing(labels, passed_over)


def _of_folder(folder: Path, include, recurse: bool, is_ours) -> tuple[list[str], int]:
    """A folder's files, and how many of them nothing here reads."""
    found, others = [], 0
    for place, folders, names in os.walk(folder):
        if SIGN in names:  # answers lie there: no surfaces, though tables of residuals can be read
            folders[:] = [each for each in folders if each not in OWN_FOLDERS]
            names = [each for each in names if each not in OWN_FILES]
        arrays = [each for each in folders if opening.is_array_folder(os.path.join(place, each))]
        folders[:] = sorted(each for each in folders if recurse and not each.startswith(".") and each not in arrays)
        for name in sorted(names + arrays):
            path = Path(place, name)
            if name.startswith(".") or not opening.is_plain(path):
                continue
            if include:
                wanted = any(fnmatch(name, pattern) for pattern in include)
            else:
                wanted = is_ours(path)
                others += not wanted
            if wanted:
                found.append(str(path))
    return found, others
