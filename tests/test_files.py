"""Files are written whole or not at all, and nothing but a plain file is ever replaced."""

import os
import stat
import threading

import pytest

from brdfguide import files
from brdfguide.errors import InputError
from brdfguide.files import write_whole

pytestmark = pytest.mark.skipif(os.name == "nt", reason="links, pipes and modes as POSIX has them")


def test_a_link_is_followed_and_stays_a_link(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_text("old")
    link.symlink_to("target")
    write_whole(link, "new")
    assert link.is_symlink() and target.read_text() == "new"


def test_a_link_to_nothing_makes_what_it_points_to(tmp_path):
    link = tmp_path / "link"
    link.symlink_to(tmp_path / "fresh")
    write_whole(link, "new")
    assert link.is_symlink() and (tmp_path / "fresh").read_text() == "new"
    link.unlink()
    link.symlink_to(tmp_path / "nowhere" / "fresh")
    with pytest.raises(InputError, match="there is no folder .*nowhere"):
        write_whole(link, "new")


def test_links_in_a_circle_are_a_sentence(tmp_path):
    (tmp_path / "a").symlink_to("b")
    (tmp_path / "b").symlink_to("a")
    with pytest.raises(InputError, match="cannot write .*symbolic links"):
        write_whole(tmp_path / "a", "new")


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o444, 0o755])
def test_a_mode_is_kept(tmp_path, mode):
    path = tmp_path / "file"
    path.write_text("old")
    path.chmod(mode)
    write_whole(path, "new")
    assert stat.S_IMODE(path.stat().st_mode) == mode and path.read_text() == "new"


def test_a_new_file_has_the_mode_that_the_user_asks_of_new_files(tmp_path):
    before = os.umask(0o027)
    try:
        write_whole(tmp_path / "file", "new")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "file").stat().st_mode) == 0o640


def test_a_pipe_is_written_into_and_stays_a_pipe(tmp_path):
    path, got = tmp_path / "pipe", []
    os.mkfifo(path)
    reader = threading.Thread(target=lambda: got.append(path.read_bytes()))
    reader.start()
    write_whole(path, b"x" * 300_000, force=False)
    reader.join()
    assert got == [b"x" * 300_000] and stat.S_ISFIFO(path.stat().st_mode)


def test_a_pipe_that_nobody_reads_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "WAITED_S", 0.1)
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match="is a pipe, and nobody read it"):
        write_whole(tmp_path / "pipe", "new")


@pytest.mark.parametrize("device, sentence", [("/dev/null", None), ("/dev/full", "No space left on device")])
def test_a_device_is_written_into_and_stays_one(device, sentence):
    if not os.path.exists(device):
        pytest.skip(f"no {device}")
    if sentence:
        with pytest.raises(InputError, match=f"cannot write {device}: {sentence}"):
            write_whole(device, "new")
    else:
        write_whole(device, "new", force=False)
    assert stat.S_ISCHR(os.stat(device).st_mode)


def test_a_socket_is_refused(tmp_path, monkeypatch):
    import socket

    monkeypatch.chdir(tmp_path)  # the name of a socket must be short
    with socket.socket(socket.AF_UNIX) as one:
        one.bind("s")
        with pytest.raises(InputError, match="neither a file nor a pipe nor a terminal"):
            write_whole("s", "new")


def test_force_is_about_plain_files_alone(tmp_path):
    (tmp_path / "file").write_text("old")
    with pytest.raises(InputError, match="file exists; --force replaces it"):
        write_whole(tmp_path / "file", "new", force=False)
    assert (tmp_path / "file").read_text() == "old"


def test_nothing_half_written_stays_behind(tmp_path, monkeypatch):
    path = tmp_path / "file"
    path.write_text("old")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(files.Path, "replace", full)
    with pytest.raises(InputError, match="No space left"):
        write_whole(path, "new")
    monkeypatch.setattr(files.Path, "replace", lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        write_whole(path, "new")
    assert [each.name for each in tmp_path.iterdir()] == ["file"] and path.read_text() == "old"


def test_a_name_as_long_as_file_systems_allow_can_be_written(tmp_path):
    write_whole(tmp_path / ("x" * 255), "new")
    with pytest.raises(InputError, match="File name too long"):
        write_whole(tmp_path / ("x" * 256), "new")


@pytest.mark.parametrize("name", ["a\0b", "\0"])
def test_a_name_that_no_file_can_have_is_a_sentence(tmp_path, name):
    with pytest.raises(InputError, match=r"cannot write .*\\x00"):
        write_whole(tmp_path / name, "new")


def test_lone_surrogates_do_not_keep_a_file_from_being_written(tmp_path):
    write_whole(tmp_path / "file", "a\ud800b")
    assert (tmp_path / "file").read_text() == r"a\ud800b"


def test_a_folder_is_made_or_the_reason_said(tmp_path):
    assert files.folder(tmp_path / "a" / "b").is_dir()
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="file is a file; wanted a folder"):
        files.folder(tmp_path / "file")
    with pytest.raises(InputError, match="cannot make the folder .*: Not a directory"):
        files.folder(tmp_path / "file" / "below")
