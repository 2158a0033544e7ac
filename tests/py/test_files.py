# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Files appear whole or not at all, whatever writes them, and only files are read, whatever reads them."""

from __future__ import annotations

import os
import re
import signal
import stat
import struct
import subprocess
import sys
import threading
import time
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from file_kinds import CONDITIONS, KEPT, PICTURE, READERS, SAMPLES, TRACK, WRITERS, motion, write_sentences
from hri import read_audio
from hri.core.errors import Error, FormatError, InvalidArgument, IoError
from hri.core.files import atomic_file, parse_json, parse_number, parse_toml, parse_whole, split_lines, write_text
from hri.datasets.manifest import read_manifest
from hri.io import write_wav_pcm16
from hri.media import VideoWriter, read_frames, read_image, write_image, write_video
from hri.robot import TrajectoryError, read_pulse_csv, read_short_csv
from hri.robot.imitation.tracks import read_hand_tracks
from hri.robot.motion.pulse_csv import write_pulse_csv
from hri.robot.motion.short_csv import check_short_csv, write_short_csv

HERE = Path(__file__).parent
OLD = b"what was there before"


def run_python(script: str, *arguments: str | bytes | Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """A script in a process of its own that finds `file_kinds`."""
    before = {name: value for name, value in os.environ.items() if not name.startswith(("LC_", "LANG"))}
    search = os.pathsep.join(filter(None, [str(HERE), os.environ.get("PYTHONPATH")]))
    return subprocess.run(
        [sys.executable, "-c", script, *arguments],
        capture_output=True,
        encoding="utf-8",
        errors="surrogateescape",
        check=False,
        timeout=120,
        env={**before, "PYTHONPATH": search, **environment},
    )


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
    """As on a full disk: the system takes the first bytes of a file and no more, and some libraries tell nobody."""
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
from file_kinds import READERS, WRITERS
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


def test_numbers_are_those_of_a_table() -> None:
    for cell, value in {"1": 1.0, " -2.5\t": -2.5, "+.5e1": 5.0, "3.": 3.0}.items():
        assert parse_number(cell) == value
    for cell in ("", "1_0", "१", "\x1f1", "1\x1f", "\xa01", "nan", "inf", "1e999", "0x1", "1e", ".", "1 2", "1\n"):
        assert parse_number(cell) is None, cell
        assert parse_whole(cell) is None, cell
    assert (parse_whole(" -12 "), parse_whole("1.0"), parse_whole("9" * 19)) == (-12, None, None)


def test_lines_end_where_editors_end_them() -> None:
    assert split_lines("a\r\nb\rc\nd\x1ce\x85f\u2028g\x0b\n") == ["a", "b", "c", "d\x1ce\x85f\u2028g\x0b"]
    assert split_lines("") == [] and split_lines("\n") == [""]


BAD_TOML = [
    "a = " + "[" * 5000,
    "a = " + "9" * 6000,
    "a = 2026-02-30",
    "a = {" + "a.b = {" * 3000,
    "a = 0x" + "f" * 9000,
]


@pytest.mark.parametrize("text", BAD_TOML, ids=range(5))
def test_toml_beyond_python_s_limits_is_no_toml(tmp_path: Path, text: str) -> None:
    if not text.startswith("a = 0x"):  # which Python reads at any length
        with pytest.raises(FormatError, match="here: not a TOML file"):
            parse_toml(text, "here")
    (tmp_path / "dataset.toml").write_text(text)
    with pytest.raises(FormatError, match=r"dataset\.toml: "):
        read_manifest(tmp_path / "dataset.toml")


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000, "9" * 6000, "NaN", "[-Infinity]", "", "\ud800"])
def test_json_beyond_python_s_limits_is_no_json(text: str) -> None:
    with pytest.raises(FormatError, match="here: not a JSON file"):
        parse_json(text, "here")


@pytest.mark.parametrize("first", [b"\xf8", b"\x1f1", "१".encode(), b"1_0", b"\xc2\xa01"])
def test_pulses_whose_first_cell_is_no_number_are_refused_by_row_and_column(tmp_path: Path, first: bytes) -> None:
    path = tmp_path / "pulses.csv"
    write_pulse_csv(path, motion())
    path.write_bytes(first + path.read_bytes())
    with pytest.raises(TrajectoryError, match=r"pulses\.csv: row 1, column A"):
        read_pulse_csv(path)


@pytest.mark.parametrize("cell", ["1_0", "१", "5\x1f", "\x1c5", "\u20285", "inf"])
def test_cell_that_is_no_number_is_refused_where_it_stands(tmp_path: Path, cell: str) -> None:
    pulses, degrees, track = tmp_path / "pulses.csv", tmp_path / "degrees.csv", tmp_path / "track.csv"
    write_pulse_csv(pulses, motion())
    rows = [line.split(",") for line in pulses.read_text().splitlines()]
    rows[4][8] = cell
    pulses.write_text("".join(",".join(row) + "\n" for row in rows), encoding="utf-8")
    with pytest.raises(TrajectoryError, match="row 5, column I"):
        read_pulse_csv(pulses)

    write_short_csv(degrees, motion())
    lines = ["# by hand", "", *degrees.read_text().splitlines()]
    cells = lines[5].split(",")
    cells[2] = cell
    lines[5] = ",".join(cells)
    degrees.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(TrajectoryError, match=r"degrees\.csv: row 6, column C \(larm_joint_2\): .* is no number"):
        read_short_csv(degrees)

    track.write_text(TRACK + f"1,2,{cell},4,5,6\n", encoding="utf-8")
    with pytest.raises(FormatError, match="row 6, column right-x"):
        read_hand_tracks(track)


def test_fault_of_a_motion_is_named_by_row_and_column_of_the_short_form(tmp_path: Path) -> None:
    path = tmp_path / "degrees.csv"
    path.write_text("# a remark\n\ntime_s,rarm_joint_1,larm_joint_1\n0,80,80\n# another\n1,80,80\n2,80,500\n3,80,500\n")
    findings = check_short_csv(path)
    outside = next(found for found in findings if "outside" in found.message)
    assert (outside.row, outside.column, outside.joint) == (7, "C", "larm_joint_1")
    assert outside.message.endswith("to row 8")
    path.write_text("time_s,larm_joint_1,leg,larm_joint_1\n0,1,1,1\n")
    with pytest.raises(TrajectoryError, match=r"row 1, column C \(leg\).*row 1, column D \(larm_joint_1\)"):
        read_short_csv(path)


def png_of(width: int, height: int) -> bytes:
    def chunk(name: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    rows = zlib.compressobj(9)
    data = b"".join(rows.compress(bytes(1 + width)) for _ in range(height)) + rows.flush()
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def test_picture_of_more_pixels_than_a_camera_has_takes_no_time(tmp_path: Path) -> None:
    (tmp_path / "vast.png").write_bytes(png_of(12_000, 12_000))
    started = time.monotonic()
    with pytest.raises(FormatError, match=r"vast\.png: 12000 x 12000 pixels"):
        read_image(tmp_path / "vast.png")
    assert time.monotonic() - started < 1.0


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".bmp"])
def test_size_of_a_picture_is_known_before_it_is_decoded(tmp_path: Path, suffix: str) -> None:
    from hri.media.picture_size import picture_size

    write_image(tmp_path / f"a{suffix}", PICTURE)
    data = (tmp_path / f"a{suffix}").read_bytes()
    assert picture_size(data) == (80, 60)
    for length in range(0, len(data), 7):
        assert picture_size(data[:length]) in (None, (80, 60))


@pytest.mark.parametrize("suffix", [".avi", ".mp4", ".webm", ".mkv"])
def test_video_cut_in_half_is_refused(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"cut{suffix}"
    noise = np.random.default_rng(0).random((40, 60, 80, 3))
    write_video(path, list((255 * noise).astype(np.uint8)), 10.0)
    assert len(read_frames(path).frames) == 40
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    with pytest.raises(FormatError, match=rf"cut\{suffix}"):
        read_frames(path)


def test_recording_that_is_too_short_is_named(tmp_path: Path, hri, spoken: Path) -> None:
    import hri as library

    write_wav_pcm16(tmp_path / "short.wav", SAMPLES[:50], 16000)
    words = library.train(spoken)
    for ask in (words.recognise, words.scores, library.SpeakerAdapter(words).recognise):
        with pytest.raises(FormatError, match=r"short\.wav: audio is too short"):
            ask(tmp_path / "short.wav")
    with pytest.raises(FormatError, match=r"short\.wav: .*too short"):
        words.add_word("new", [spoken / "1_low_0.wav", tmp_path / "short.wav"])
    with pytest.raises(InvalidArgument, match=r"^audio is too short"):
        words.recognise(read_audio(tmp_path / "short.wav").samples, 16000)
    result = hri("features", tmp_path / "short.wav")
    assert result.code == 3 and "short.wav: audio is too short" in result.err


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


def test_kept_files_of_studies_are_read_as_strictly(tmp_path: Path) -> None:
    for name, text in (("kept.json", KEPT), ("conditions.toml", CONDITIONS), ("track.csv", TRACK)):
        (tmp_path / name).write_text(text)
        READERS[name](tmp_path / name)
    (tmp_path / "kept.json").write_text("[" * 100_000)
    (tmp_path / "conditions.toml").write_text("a = " + "[" * 5000)
    for name in ("kept.json", "conditions.toml"):
        with pytest.raises(InvalidArgument, match=r"kept result|table of conditions"):
            READERS[name](tmp_path / name)
    write_sentences(tmp_path)
    READERS["signers.csv"](tmp_path / "signers.csv")
