"""No file holds us up: pipes without a writer, devices without an end, names that no file can have."""

import os
import threading

import pytest

from brdfguide import opening
from brdfguide.errors import InputError

pytestmark = pytest.mark.skipif(os.name == "nt", reason="pipes and devices as POSIX has them")


def test_a_pipe_is_read_once_somebody_writes(tmp_path):
    path = tmp_path / "pipe"
    os.mkfifo(path)

    def write():
        with path.open("wb") as stream:
            stream.write(b"a" * 200_000)

    writer = threading.Timer(0.15, write)
    writer.start()
    assert opening.content(path, 10**6, "pipe") == b"a" * 200_000
    writer.join()


def test_a_writer_who_is_gone_again_was_heard(tmp_path, monkeypatch):
    monkeypatch.setattr(opening, "PIECE", 3)
    path = tmp_path / "pipe"
    os.mkfifo(path)
    writer = threading.Timer(0.05, lambda: path.write_bytes(b"abcdefgh"))
    writer.start()
    with opening.open_for_reading(path, "pipe") as stream:
        assert stream.read(2) == b"ab" and stream.read(100) == b"cdefgh" and stream.read(1) == b""
    writer.join()


def test_a_pipe_that_nobody_feeds_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(opening, "WAITED_S", 0.1)
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match="is a pipe, and nobody wrote into it"):
        opening.content(tmp_path / "pipe", 10, "pipe")


def test_an_endless_file_is_left_at_the_limit():
    with pytest.raises(InputError, match="goes on beyond 3 MB"):
        opening.content("/dev/zero", 3 * 10**6, "zero")


@pytest.mark.parametrize("name, sentence", [("a\0b", "zero byte"), ("x" * 300, "File name too long")])
def test_a_name_that_no_file_can_have_is_a_sentence(name, sentence):
    with pytest.raises(InputError, match=sentence), opening.open_for_reading(name, name):
        pass
    assert not opening.exists(name) and not opening.is_plain(name)


def test_plain_is_what_ends_and_can_be_read_again(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "link").symlink_to("file")
    (tmp_path / "null").symlink_to("/dev/null")
    os.mkfifo(tmp_path / "pipe")
    plain = [name for name in ("file", "link", "null", "pipe", "none") if opening.is_plain(tmp_path / name)]
    assert plain == ["file", "link"]
    assert not opening.is_plain("/proc/self/mem") and not opening.is_plain("/dev/zero") and not opening.is_plain("/")


def test_what_is_held_is_read_as_often_as_one_likes():
    held = opening.Held("-", b"abc")
    assert opening.content(held, 10, "-") == opening.content(held, 10, "-") == b"abc" and str(held) == "-"
