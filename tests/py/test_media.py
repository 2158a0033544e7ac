# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sound, pictures and video in and out of files, and what becomes of broken ones."""

from __future__ import annotations

import builtins
import struct
import subprocess
import sys
import zlib
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.media import iterate_frames, read_audio, read_frames, read_image, write_image, write_video

cv2 = pytest.importorskip("cv2")


def wav_bytes(samples: np.ndarray, rate: int = 8000, channels: int = 1, data_size: int | None = None) -> bytes:
    """A WAV file, float32 or int16 as `samples`; `data_size` goes before the true size."""
    code = 3 if samples.dtype == np.float32 else 1
    width = samples.dtype.itemsize
    body = samples.tobytes()
    size = len(body) if data_size is None else data_size
    head = struct.pack(
        "<4sI4s4sIHHIIHH4sI",
        *(b"RIFF", min(36 + size, 0xFFFFFFFF), b"WAVE", b"fmt ", 16, code, channels, rate),
        *(rate * channels * width, channels * width, 8 * width, b"data", size),
    )
    return head + body


def tone(num_samples: int = 400) -> np.ndarray:
    return (8000 * np.sin(0.3 * np.arange(num_samples))).astype(np.int16)


def write_wav(path: Path, samples: np.ndarray, **options: int) -> Path:
    path.write_bytes(wav_bytes(samples, **options))
    return path


def test_wav_gives_its_samples_and_rate(tmp_path: Path) -> None:
    audio = read_audio(write_wav(tmp_path / "a.wav", tone(), rate=16000))
    assert audio.sample_rate_hz == 16000
    assert audio.samples.dtype == np.float32
    np.testing.assert_allclose(audio.samples, tone() / 32768.0, atol=1e-7)
    assert audio.duration_s == 400 / 16000
    assert audio.notes == []


def test_stereo_is_averaged_and_said(tmp_path: Path) -> None:
    pairs = np.stack([tone(), np.zeros(400, np.int16)], axis=1)
    audio = read_audio(write_wav(tmp_path / "a.wav", pairs, channels=2))
    np.testing.assert_allclose(audio.samples, tone() / 65536.0, atol=1e-6)
    assert any("2" in note for note in audio.notes)


@pytest.mark.parametrize("claimed", [2000, 0xFFFFFFFF])
def test_wav_shorter_than_its_header_is_read_in_part_and_said(tmp_path: Path, claimed: int) -> None:
    audio = read_audio(write_wav(tmp_path / "a.wav", tone(), data_size=claimed))
    assert len(audio.samples) == 400
    assert audio.notes


def test_wav_without_samples_is_refused(tmp_path: Path) -> None:
    path = write_wav(tmp_path / "none.wav", tone(0))
    with pytest.raises(FormatError, match=r"none\.wav"):
        read_audio(path)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_value_that_is_not_finite_is_refused_with_its_index(tmp_path: Path, bad: float) -> None:
    samples = np.zeros(100, dtype=np.float32)
    samples[37] = bad
    path = write_wav(tmp_path / "bad.wav", samples)
    with pytest.raises(FormatError, match=r"bad\.wav.*37"):
        read_audio(path)


@pytest.mark.parametrize("content", [b"", b"RIFF", b"hello, this is no sound at all" * 10])
def test_file_that_is_no_wav_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "no.wav"
    path.write_bytes(content)
    with pytest.raises(FormatError, match=r"no\.wav"):
        read_audio(path)


@pytest.mark.parametrize("read", [read_audio, read_frames])
@pytest.mark.parametrize("suffix", [".wav", ".flac", ".jpg", ".mp4"])
def test_missing_file_is_an_os_error_with_its_path(tmp_path: Path, read, suffix: str) -> None:
    with pytest.raises(IoError, match="gone") as caught:
        read(tmp_path / f"gone{suffix}")
    assert isinstance(caught.value, OSError)


def test_flac_is_read_by_soundfile(tmp_path: Path) -> None:
    soundfile = pytest.importorskip("soundfile")
    pairs = np.stack([tone(), tone()], axis=1)
    soundfile.write(tmp_path / "a.flac", pairs, 8000)
    audio = read_audio(tmp_path / "a.flac")
    np.testing.assert_allclose(audio.samples, tone() / 32768.0, atol=1e-6)
    assert audio.notes == ["averaged 2 channels to mono"]


def test_broken_flac_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("soundfile")
    (tmp_path / "a.flac").write_bytes(b"fLaC" + bytes(100))
    with pytest.raises(FormatError, match=r"a\.flac"):
        read_audio(tmp_path / "a.flac")


@pytest.mark.parametrize(("name", "module", "extra"), [("a.flac", "soundfile", "audio"), ("a.jpg", "cv2", "video")])
def test_missing_library_is_named_with_its_extra(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, module: str, extra: str
) -> None:
    real_import = builtins.__import__

    def refuse(wanted: str, *args, **kwargs):
        if wanted == module:
            raise ImportError(f"No module named {wanted}")
        return real_import(wanted, *args, **kwargs)

    monkeypatch.setitem(sys.modules, module, None)
    monkeypatch.setattr(builtins, "__import__", refuse)
    (tmp_path / name).write_bytes(b"x")
    read = read_audio if module == "soundfile" else read_frames
    with pytest.raises(ImportError, match=rf"{module}.*libhri\[{extra}\]"):
        read(tmp_path / name)


def test_media_import_loads_no_optional_library() -> None:
    code = "import sys, hri.media; print([m for m in ('cv2', 'soundfile') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def frames_of(count: int, height: int = 48, width: int = 64) -> list[np.ndarray]:
    return [np.full((height, width, 3), 10 * i, dtype=np.uint8) for i in range(count)]


@pytest.mark.parametrize("suffix", [".mp4", ".m4v", ".avi", ".mkv", ".webm"])
def test_video_comes_back_with_its_times(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"clip{suffix}"
    write_video(path, iter(frames_of(12)), fps=10.0)
    clip = read_frames(path)
    assert clip.path == path
    assert len(clip.frames) == 12
    np.testing.assert_allclose(clip.times_s, np.arange(12) / 10.0, atol=2e-3)
    for index, frame in enumerate(clip.frames):
        assert frame.shape == (48, 64, 3)
        assert frame.dtype == np.uint8
        assert abs(float(frame.mean()) - 10 * index) < 6
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("suffix", [".mp4", ".avi", ".webm"])
def test_reading_and_writing_video_prints_nothing(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], suffix: str
) -> None:
    write_video(tmp_path / f"a{suffix}", frames_of(3), fps=10.0)
    read_frames(tmp_path / f"a{suffix}")
    (tmp_path / f"no{suffix}").write_bytes(b"x" * 500)
    with pytest.raises(FormatError):
        read_frames(tmp_path / f"no{suffix}")
    assert capfd.readouterr() == ("", "")


def test_max_frames_stops_early(tmp_path: Path) -> None:
    write_video(tmp_path / "a.avi", frames_of(9), fps=10.0)
    assert len(read_frames(tmp_path / "a.avi", max_frames=4).frames) == 4
    with pytest.raises(InvalidArgument, match="max_frames is 0"):
        read_frames(tmp_path / "a.avi", max_frames=0)


def test_picture_is_a_clip_of_one_frame(tmp_path: Path) -> None:
    picture = np.random.default_rng(0).integers(0, 255, (20, 30, 3), dtype=np.uint8)
    write_image(tmp_path / "a.png", picture)
    clip = read_frames(tmp_path / "a.png")
    assert clip.times_s == [0.0]
    np.testing.assert_array_equal(clip.frames[0], picture)


@pytest.mark.parametrize("suffix", [".jpg", ".png", ".mp4", ".avi", ".m4v"])
@pytest.mark.parametrize("content", [b"", b"this is neither picture nor video" * 50])
def test_file_that_is_no_video_is_refused(tmp_path: Path, suffix: str, content: bytes) -> None:
    path = tmp_path / f"no{suffix}"
    path.write_bytes(content)
    with pytest.raises(FormatError, match=f"no{suffix}"):
        read_frames(path)


def test_video_without_frames_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "empty.avi"
    write_video(path, frames_of(3), fps=10.0)
    data = path.read_bytes()
    path.write_bytes(data[: data.index(b"movi") + 4])  # headers only
    with pytest.raises(FormatError, match=r"empty\.avi"):
        read_frames(path)


def test_time_that_runs_backwards_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "back.mkv"
    write_video(path, frames_of(8), fps=10.0)
    data = bytearray(path.read_bytes())
    blocks = []  # a Matroska block: track 1, time (2 bytes), flags, then the JPEG picture
    start = 0
    while (start := data.find(b"\xff\xd8\xff", start)) >= 0:
        if data[start - 4] == 0x81:
            blocks.append(start - 3)
        start += 3
    assert len(blocks) == 8
    data[blocks[5] : blocks[5] + 2] = struct.pack(">h", 150)
    path.write_bytes(bytes(data))
    with pytest.raises(FormatError, match=r"back\.mkv: time runs backwards: frame 5"):
        read_frames(path)
    assert len(list(islice(iterate_frames(path), 5))) == 5


@pytest.mark.parametrize(
    ("frames", "fps", "name", "message"),
    [
        ([], 10.0, "a.mp4", "no frames"),
        (frames_of(1) + frames_of(1, 50), 10.0, "a.mp4", "frame 1 has shape"),
        ([np.zeros((48, 64), np.uint8)], 10.0, "a.mp4", "frame 0 has shape"),
        ([np.zeros((48, 64, 3), np.float32)], 10.0, "a.mp4", "float32"),
        (frames_of(1), 0.0, "a.mp4", "fps is 0"),
        (frames_of(1), float("nan"), "a.mp4", "fps is nan"),
        (frames_of(1), 10.0, "a.txt", "suffix"),
    ],
)
def test_frames_that_make_no_video_leave_no_file(
    tmp_path: Path, frames: list[np.ndarray], fps: float, name: str, message: str
) -> None:
    with pytest.raises(InvalidArgument, match=message):
        write_video(tmp_path / name, frames, fps)
    assert list(tmp_path.iterdir()) == []


def test_failed_write_keeps_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "a.avi"
    write_video(path, frames_of(3), fps=10.0)
    before = path.read_bytes()
    with pytest.raises(InvalidArgument):
        write_video(path, frames_of(1) + frames_of(1, 50), fps=10.0)
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["a.avi"]


def test_missing_folder_is_named(tmp_path: Path) -> None:
    for write in (
        lambda: write_video(tmp_path / "none" / "a.mp4", frames_of(1), 10.0),
        lambda: write_image(tmp_path / "none" / "a.png", frames_of(1)[0]),
    ):
        with pytest.raises(IoError, match="none"):
            write()


def test_picture_suffix_is_checked(tmp_path: Path) -> None:
    with pytest.raises(InvalidArgument, match="suffix"):
        write_image(tmp_path / "a.tiff", frames_of(1)[0])


def test_grey_picture_comes_back_in_three_channels(tmp_path: Path) -> None:
    write_image(tmp_path / "a.png", np.arange(64, dtype=np.uint8).reshape(8, 8))
    assert read_image(tmp_path / "a.png").shape == (8, 8, 3)


def test_picture_of_absurd_size_is_refused(tmp_path: Path) -> None:
    head = struct.pack(">IIBBBBB", 2**30, 2**30, 8, 2, 0, 0, 0)
    chunk = struct.pack(">I", 13) + b"IHDR" + head + struct.pack(">I", zlib.crc32(b"IHDR" + head))
    (tmp_path / "huge.png").write_bytes(b"\x89PNG\r\n\x1a\n" + chunk + bytes(64))
    with pytest.raises(FormatError, match=r"huge\.png"):
        read_image(tmp_path / "huge.png")
