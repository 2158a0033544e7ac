# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Files appear whole or not at all, whatever writes them, and only files are read, whatever reads them."""

from __future__ import annotations

import os
import re
import signal
import stat
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from file_kinds import READERS, WRITERS, run_python
from hri.core.errors import Error, FormatError, InvalidArgument, IoError
from hri.core.files import atomic_file, write_text
from hri.media import VideoWriter, read_frames

OLD = b"what was there before"


@pytest.mark.parametrize("name", WRITERS)
def test_writer_keeps_permissions_and_links_and_leaves_nothing_beside(tmp_path: Path, name: str) -> None:
    write = WRITERS[name]
    store, place = tmp_path / "store", tmp_path / "place"
    store.mkdir()
    place.mkdir()
    (store / name).write_bytes(OLD)
    (store / name).chmod(0o640)
    (place / name).symlink_to(store / name)
    write(place / name)
    assert (place / name).is_symlink()
    assert (store / name).read_bytes() != OLD and (store / name).stat().st_size > 0
    assert stat.S_IMODE((store / name).stat().st_mode) == 0o640
    assert [path.name for path in store.iterdir()] == [name]
    assert {path.name for path in place.iterdir()} <= {name, "odd.csv"}


@pytest.mark.parametrize("name", WRITERS)
def test_writers_of_one_file_at_once_leave_one_of_theirs_whole(tmp_path: Path, name: str) -> None:
    alone = tmp_path / "alone"
    alone.mkdir()
    WRITERS[name](alone / name)
    shared = tmp_path / "shared"
    shared.mkdir()
    if (alone / "odd.csv").exists():
        (alone / "odd.csv").rename(shared / "odd.csv")
    with ThreadPoolExecutor(6) as pool:
        for done in [pool.submit(WRITERS[name], shared / name) for _ in range(12)]:
            done.result()
    size = (alone / name).stat().st_size
    assert abs((shared / name).stat().st_size - size) < 200  # a video or a figure holds when it was made
    assert {path.name for path in shared.iterdir()} <= {name, "odd.csv"}


def test_no_writer_harms_the_old_file_on_a_full_disk(tmp_path: Path) -> None:
    """As on a full disk: the system takes the first bytes of a file and no more, and some libraries hide it."""
    script = """
import resource, sys
from pathlib import Path
from file_kinds import WRITERS, write_repaired
from hri.core.errors import IoError
folder = Path(sys.argv[1])
write_repaired(folder / "repaired.csv")
for name in WRITERS:
    (folder / name).write_bytes(b"what was there before")
before = sorted(path.name for path in folder.iterdir())
resource.setrlimit(resource.RLIMIT_FSIZE, (1200, resource.RLIM_INFINITY))
for name, write in WRITERS.items():
    try:
        write(folder / name)
        print(name, "was written")
    except IoError as error:
        if name not in str(error):
            print(name, "is not named:", error)
    if (folder / name).read_bytes() != b"what was there before":
        print(name, "is harmed")
if sorted(path.name for path in folder.iterdir()) != before:
    print("left:", sorted(path.name for path in folder.iterdir()))
"""
    done = run_python(script, tmp_path)
    assert (done.returncode, done.stdout) == (0, ""), done.stdout + done.stderr


@pytest.mark.parametrize("suffix", [".avi", ".mp4", ".webm", ".mkv"])
def test_video_of_which_the_end_is_missing_is_not_kept(
    tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The frames are in the file's beginning, and the rest did not fit."""
    path = tmp_path / f"clip{suffix}"
    path.write_bytes(OLD)
    noise = np.random.default_rng(0)
    writer = VideoWriter(path, 10.0)
    for _ in range(30):
        writer.write((noise.random((60, 80, 3)) * 255).astype(np.uint8))
    release = writer._writer.release

    def cut() -> None:
        release()
        (part,) = tmp_path.glob(".clip*")
        os.truncate(part, part.stat().st_size * 3 // 4)

    monkeypatch.setattr(writer, "_writer", type("Released", (), {"release": staticmethod(cut)}))
    with pytest.raises(IoError, match=rf"clip\{suffix}.*disk full"):
        writer.close()
    assert path.read_bytes() == OLD and len(list(tmp_path.iterdir())) == 1


def test_what_a_killed_writer_left_is_removed_by_the_next(tmp_path: Path) -> None:
    script = """
import os, signal, sys
from file_kinds import PICTURE
from hri.media import VideoWriter
from hri.core.files import atomic_file
from pathlib import Path
folder = Path(sys.argv[1])
writer = VideoWriter(folder / "clip.avi", 10.0)
writer.write(PICTURE)
with atomic_file(folder / "table.csv") as file:
    file.write(b"half")
    os.kill(os.getpid(), signal.SIGKILL)
"""
    assert run_python(script, tmp_path).returncode == -signal.SIGKILL
    left = list(tmp_path.iterdir())
    assert len(left) == 2 and all(path.name.startswith(".") for path in left)
    next_run = "import sys; from hri.core.files import write_text; write_text(sys.argv[1], 'whole')"
    assert run_python(next_run, tmp_path / "other.txt").returncode == 0
    assert [path.name for path in tmp_path.iterdir()] == ["other.txt"]


def test_a_block_that_fails_leaves_the_old_file(tmp_path: Path) -> None:
    write_text(tmp_path / "a", "old")
    with pytest.raises(TypeError), atomic_file(tmp_path / "a") as file:
        file.write("no bytes")  # type: ignore[arg-type]
    assert (tmp_path / "a").read_text() == "old" and len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("name", WRITERS)
def test_writer_refuses_what_is_no_place_for_a_file(tmp_path: Path, name: str) -> None:
    folder, pipe = tmp_path / "folder" / name, tmp_path / name
    folder.mkdir(parents=True)
    os.mkfifo(pipe)
    for place in (folder, pipe):
        with pytest.raises(IoError, match=name):
            WRITERS[name](place)
    assert stat.S_ISFIFO(pipe.stat().st_mode) and list(folder.iterdir()) == []


def test_reader_refuses_a_pipe_and_a_device_without_waiting(tmp_path: Path) -> None:
    script = """
import os, sys
from pathlib import Path
from file_kinds import READERS
from hri.core.errors import Error, IoError
folder = Path(sys.argv[1])
for name, read in READERS.items():
    pipe, device, nothing = folder / "pipe" / name, folder / "device" / name, folder / "gone" / name
    for place in (pipe, device, nothing):
        place.parent.mkdir(exist_ok=True)
    os.mkfifo(pipe)
    device.symlink_to("/dev/zero")
    for place in (pipe, device, nothing):
        print(place, end=": ", flush=True)
        try:
            read(place)
            print("was read")
        except Error as error:
            print("refused" if name in str(error) else f"refused, but not named: {error}")
"""
    done = run_python(script, tmp_path)
    lines = done.stdout.splitlines()
    assert len(lines) == 3 * len(READERS), done.stdout[-500:] + done.stderr
    assert [line for line in lines if not line.endswith(": refused")] == []


def test_reader_of_a_folder_refuses_by_name(tmp_path: Path) -> None:
    for name, read in READERS.items():
        (tmp_path / name).mkdir()
        if read is read_frames:  # a folder of pictures is a clip
            continue
        with pytest.raises(Error, match=re.escape(name)):
            read(tmp_path / name)


@pytest.mark.parametrize("locale", [{"LC_ALL": "C.UTF-8"}, {"LC_ALL": "C"}, {"LC_ALL": "C", "PYTHONUTF8": "0"}])
def test_any_name_that_the_system_allows_is_written_and_read(tmp_path: Path, locale: dict[str, str]) -> None:
    script = """
import os, sys
from pathlib import Path
from file_kinds import READERS, WRITERS, run_python
for text in sys.argv[1:]:
    for kind, write in WRITERS.items():
        place = Path(text + Path(kind).suffix)
        write(place)
        if kind in READERS:
            read = READERS[kind]
            read(place)
        os.unlink(place)
        if kind in READERS:
            try:
                read(place)
            except OSError as error:
                assert str(place) in str(error), ascii(error)
"""
    names = [b"\xe0\xa4\xb9\xe0\xa4\xbe\xe0\xa4\xa5", b"m\xe4nnchen", b"a b\tc%d"]
    done = run_python(script, *(os.fsencode(tmp_path) + b"/" + name for name in names), **locale)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("path", ["a\0b.{}", "\ud800.{}"])
def test_path_that_no_file_can_have_is_refused(tmp_path: Path, path: str) -> None:
    suffixes = {name: Path(name).suffix[1:] for name in (*READERS, *WRITERS)}
    for name, use in {**WRITERS, **READERS}.items():
        with pytest.raises((InvalidArgument, IoError, FormatError)):
            use(str(tmp_path / path.format(suffixes[name])))
    assert {path.name for path in tmp_path.iterdir()} <= {"odd.csv"}


def test_reading_goes_on_while_others_write(tmp_path: Path) -> None:
    """A reader sees the old file or the new one."""
    path = tmp_path / "shared.txt"
    texts = {letter * 50_000 for letter in "ab"}
    write_text(path, "a" * 50_000)
    stop = threading.Event()

    def write() -> None:
        while not stop.is_set():
            for text in texts:
                write_text(path, text)

    writer = threading.Thread(target=write)
    writer.start()
    try:
        assert all(path.read_text() in texts for _ in range(200))
    finally:
        stop.set()
        writer.join()


def test_names_go_to_standard_output_as_they_are(tmp_path: Path) -> None:
    script = "import sys; from hri.cli.main import run; sys.argv[1:] = ['robot', 'convert', 'wave', sys.argv[1]]; run()"
    for name in ("हाथ.csv".encode(), b"m\xe4nnchen.csv"):
        place = os.fsencode(tmp_path) + b"/" + name
        for locale in ({"LC_ALL": "C", "PYTHONUTF8": "0"}, {"LC_ALL": "C.UTF-8", "PYTHONIOENCODING": "utf-8:strict"}):
            done = run_python(script, place, **locale)
            assert (done.returncode, os.fsencode(done.stdout)) == (0, place + b"\n"), done.stderr
