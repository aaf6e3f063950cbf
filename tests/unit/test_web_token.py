"""The token of a folder's page: kept for its owner alone, made anew where others could know it."""

import os
import stat

import pytest

from asperity.web.token import token_of


@pytest.fixture
def kept(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return lambda: [path for path in tmp_path.glob("cache/asperity/pages/*") if path.is_file()]


def test_a_folder_has_the_same_token_each_time_and_another_folder_another(tmp_path, kept):
    one = token_of(tmp_path)
    assert len(one) == 32
    assert token_of(tmp_path) == one
    assert token_of(tmp_path / "other") != one
    assert len(kept()) == 2


@pytest.mark.skipif(os.name != "posix", reason="permissions are those of POSIX")
def test_nobody_else_may_read_it_and_what_others_could_read_is_made_anew(tmp_path, kept):
    one = token_of(tmp_path)
    (file,) = kept()
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    file.chmod(0o644)
    other = token_of(tmp_path)
    assert other != one
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert token_of(tmp_path) == other


@pytest.mark.skipif(os.name != "posix", reason="links are those of POSIX")
def test_a_link_and_what_is_no_token_are_not_taken(tmp_path, kept):
    token_of(tmp_path)
    (file,) = kept()
    file.unlink()
    (tmp_path / "planted").write_text("p" * 32)
    (tmp_path / "planted").chmod(0o600)
    file.symlink_to(tmp_path / "planted")
    assert token_of(tmp_path) != "p" * 32
    assert not file.is_symlink()
    for text in ("", "short", "q" * 33, "\xff" * 32):
        file.write_bytes(text.encode("latin-1"))
        file.chmod(0o600)
        assert token_of(tmp_path) != text


def test_where_nothing_can_be_kept_there_is_a_token_all_the_same(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    one, other = token_of(tmp_path), token_of(tmp_path)
    assert len(one) == len(other) == 32
    assert one != other
