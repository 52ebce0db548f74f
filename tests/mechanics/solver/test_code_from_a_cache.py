"""Machine code is loaded only from a folder in which nobody but the user can have put it."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import pytest

from certkit.files.own_folder import KEY, OwnFolder
from certkit.mechanics.solver import object_cache

posix = pytest.mark.skipif(not hasattr(os, "geteuid"), reason="no owners and modes here")
root = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root gives files away"
)


@pytest.fixture
def own(tmp_path: Path) -> OwnFolder:
    return OwnFolder(tmp_path / "cache")


def test_what_was_written_is_read(own: OwnFolder):
    own.write("a.o", b"code")
    assert OwnFolder(own.path).read("a.o") == b"code"
    assert own.read("b.o") is None


@posix
def test_folder_key_and_file_are_the_users_alone(own: OwnFolder):
    own.write("a.o", b"code")
    assert own.path.stat().st_mode & 0o777 == 0o700
    assert {path.name: path.stat().st_mode & 0o777 for path in own.path.iterdir()} == {
        KEY: 0o600,
        "a.o": 0o600,
    }


def test_a_file_with_a_plain_digest_under_another_name_or_changed_is_not_read(own: OwnFolder):
    own.write("a.o", b"code")
    written = (own.path / "a.o").read_bytes()
    (own.path / "b.o").write_bytes(written)
    assert own.read("b.o") is None
    for content in (hashlib.sha256(b"mine").digest() + b"mine", written[:-1] + b"x", b"", b"x" * 10):
        (own.path / "a.o").write_bytes(content)
        assert own.read("a.o") is None


def test_a_file_made_with_another_folders_key_is_not_read(own: OwnFolder, tmp_path: Path):
    other = OwnFolder(tmp_path / "other")
    other.write("a.o", b"code")
    (own.path / "a.o").write_bytes((other.path / "a.o").read_bytes())
    assert own.read("a.o") is None


@posix
@pytest.mark.parametrize("mode", [0o620, 0o602, 0o666])
def test_a_file_that_others_can_write_is_not_read(own: OwnFolder, mode: int):
    own.write("a.o", b"code")
    (own.path / "a.o").chmod(mode)
    assert own.read("a.o") is None


@posix
def test_a_link_is_not_followed_and_a_pipe_is_not_waited_for(own: OwnFolder):
    own.write("a.o", b"code")
    (own.path / "a.o").rename(own.path.parent / "elsewhere")
    (own.path / "a.o").symlink_to(own.path.parent / "elsewhere")
    assert own.read("a.o") is None
    os.mkfifo(own.path / "pipe.o")
    assert own.read("pipe.o") is None


@posix
@pytest.mark.parametrize("mode", [0o777, 0o1777, 0o770, 0o702])
@pytest.mark.parametrize("level", [0, 1])
def test_a_folder_in_or_above_which_others_can_write_is_refused(tmp_path: Path, mode: int, level: int):
    path = tmp_path / "above" / "cache"
    OwnFolder(path)
    (path, path.parent)[level].chmod(mode)
    if level and mode == 0o1777:
        OwnFolder(path)  # nobody moves what belongs to others in a sticky folder, as /tmp is
        return
    with pytest.raises(PermissionError, match="others could write"):
        OwnFolder(path)


@root
@pytest.mark.parametrize("what", ["", "a.o", KEY])
def test_what_belongs_to_another_user_is_not_used(own: OwnFolder, what: str):
    own.write("a.o", b"code")
    os.chown(own.path / what, 12345, 12345)
    if what:
        assert OwnFolder(own.path).read("a.o") is None
    else:
        with pytest.raises(PermissionError):
            OwnFolder(own.path)


@posix
def test_a_key_that_others_could_read_is_made_anew(own: OwnFolder):
    own.write("a.o", b"code")
    (own.path / KEY).chmod(0o644)
    again = OwnFolder(own.path)
    assert again.read("a.o") is None
    again.write("a.o", b"newer")
    assert OwnFolder(own.path).read("a.o") == b"newer"


def test_without_a_home_nothing_is_kept_and_one_line_says_so(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.chdir(tmp_path)
    for name in ("CERTKIT_CACHE", "XDG_CACHE_HOME", "HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(os.path, "expanduser", lambda path: path)  # as for a user whom nobody knows
    assert object_cache._cache() is None
    assert list(tmp_path.iterdir()) == []
    (said,) = capsys.readouterr().err.splitlines()
    assert "cannot be kept in ~/.cache/certkit" in said


@posix
def test_in_a_folder_that_others_can_write_the_loop_is_compiled_and_not_kept(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    tmp_path.chmod(0o777)
    monkeypatch.setenv("CERTKIT_CACHE", str(tmp_path))
    asked = []
    monkeypatch.setattr(object_cache, "compile_loop", lambda: asked.append(1))
    monkeypatch.setattr(object_cache, "by_numba", lambda: lambda _: (0, 0))
    object_cache.loop.cache_clear()
    try:
        object_cache.loop()
    finally:
        object_cache.loop.cache_clear()
    assert asked == [1]
    assert list(tmp_path.iterdir()) == []
    assert "others could write" in capsys.readouterr().err


def test_the_first_run_says_what_takes_so_long(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.setenv("CERTKIT_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(object_cache, "compile_loop", lambda: None)
    monkeypatch.setattr(object_cache, "by_numba", lambda: lambda _: (0, 0))
    object_cache.loop.cache_clear()
    try:
        object_cache.loop()
    finally:
        object_cache.loop.cache_clear()
    assert "compiling the solver for this machine" in capsys.readouterr().err
