# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What is wrong in a file is named: its name, row and column; and absurd contents take neither time nor memory."""

from __future__ import annotations

import os
import shutil
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from file_kinds import CONDITIONS, KEPT, PICTURE, READERS, SAMPLES, TRACK, motion, run_python, write_sentences
from hri import Dataset, WordRecognizer, read_audio
from hri.core.errors import FormatError, InvalidArgument
from hri.core.files import parse_json, parse_number, parse_toml, parse_whole, split_lines
from hri.datasets.manifest import read_manifest
from hri.io import write_wav_pcm16
from hri.media import read_frames, read_image, write_image, write_video
from hri.robot import TrajectoryError, read_pulse_csv, read_short_csv
from hri.robot.imitation.tracks import read_hand_tracks
from hri.robot.motion.pulse_csv import write_pulse_csv
from hri.robot.motion.short_csv import check_short_csv, write_short_csv

pytestmark = pytest.mark.usefixtures("few_fillers")


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


def test_picture_of_more_pixels_than_a_camera_has_is_not_decoded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import cv2

    decoded = []
    decode = cv2.imdecode
    monkeypatch.setattr(cv2, "imdecode", lambda *arguments: decoded.append(arguments) or decode(*arguments))
    (tmp_path / "small.png").write_bytes(png_of(80, 60))
    assert read_image(tmp_path / "small.png").shape == (60, 80, 3) and len(decoded) == 1
    (tmp_path / "vast.png").write_bytes(png_of(12_000, 12_000))
    with pytest.raises(FormatError, match=r"vast\.png: 12000 x 12000 pixels"):
        read_image(tmp_path / "vast.png")
    assert len(decoded) == 1


@pytest.mark.parametrize(("at", "length"), [(29 + 4, 0xFF000000), (29 + 4, 20_000_000), (8, 0x7FFFFFFF)])
def test_chunk_of_a_png_that_claims_gigabytes_takes_no_memory(tmp_path: Path, at: int, length: int) -> None:
    script = """
import resource, sys
from hri.core.errors import FormatError
from hri.media import read_image
read_image(sys.argv[1])
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
try:
    read_image(sys.argv[2])
except FormatError as error:
    assert "claims.png" in str(error), error
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
"""
    data = bytearray(png_of(80, 60))
    (tmp_path / "sound.png").write_bytes(data)
    struct.pack_into(">I", data, at, length)
    (tmp_path / "claims.png").write_bytes(data)
    done = run_python(script, tmp_path / "sound.png", tmp_path / "claims.png")
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) < 50_000  # KiB


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


def test_label_that_is_no_text_is_refused_by_the_name_of_its_file(tmp_path: Path) -> None:
    for label in (b"w\xf8rt", b"two"):
        folder = Path(os.fsdecode(os.fsencode(tmp_path) + b"/" + label))
        folder.mkdir()
        for take in range(3):
            write_wav_pcm16(folder / f"ann_{take}.wav", SAMPLES, 8000)
    with pytest.raises(FormatError, match=r"w\udcf8rt.*not UTF-8.*label"):
        Dataset.load(tmp_path)
    with pytest.raises(InvalidArgument, match=r"y\[1\].*not UTF-8"):
        WordRecognizer().fit([SAMPLES] * 2, ["one", "w\udcf8rt"], sample_rate_hz=8000)


@pytest.mark.parametrize("command", ["train", "evaluate"])
def test_recording_among_others_that_is_too_short_is_named(hri, spoken: Path, tmp_path: Path, command: str) -> None:
    folder = shutil.copytree(spoken, tmp_path / "spoken")
    write_wav_pcm16(folder / "1_low_0.wav", SAMPLES[:20], 16000)
    result = hri(command, "speech", "--data", folder, *(["--out", tmp_path / "m.hri"] if command == "train" else []))
    assert result.code == 3 and "1_low_0.wav: audio is too short" in result.err
