# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Sound, pictures and video that are damaged, hostile or only unusual."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hri.core.errors import FormatError, InvalidArgument, IoError
from hri.media import frame_rate, natural_key, read_audio, read_frames, read_image, write_image, write_video
from hri.media import video as module
from hri.media.suffixes import kind_of_file
from hri.media.video import encode_png
from hri.media.video_writer import VideoWriter

cv2 = pytest.importorskip("cv2")


def moving_square(count: int, height: int = 48, width: int = 64) -> list[np.ndarray]:
    noise = np.random.default_rng(0).integers(0, 60, (height, width, 3), dtype=np.uint8)
    frames = []
    for number in range(count):
        frame = noise.copy()
        frame[10:30, number % 40 : number % 40 + 16] = (200, 120, 60)
        frames.append(frame)
    return frames


def test_a_damaged_frame_in_the_middle_of_a_video_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "clip.mp4"
    write_video(path, moving_square(40), 25)
    data = bytearray(path.read_bytes())
    middle = len(data) // 2
    data[middle : middle + 3000] = np.random.default_rng(1).integers(0, 256, 3000, dtype=np.uint8).tobytes()
    path.write_bytes(data)
    with pytest.raises(FormatError, match=r"clip\.mp4: frame 23 is damaged"):
        read_frames(path)


class Capture:
    """OpenCV's reader of three frames, by what it says of them."""

    def __init__(self, frames: list[bool], times_ms: list[float]) -> None:
        self._frames, self._times_ms = list(frames), list(times_ms)
        self._time_ms = 0.0

    def read(self) -> tuple[bool, Any]:
        if not self._frames or not self._frames.pop(0):
            return False, None
        self._time_ms = self._times_ms.pop(0)
        return True, np.zeros((4, 4, 3), np.uint8)

    def grab(self) -> bool:
        return bool(self._frames) and self._frames.pop(0)

    def get(self, what: int) -> float:
        return self._time_ms if what == cv2.CAP_PROP_POS_MSEC else 0.0


def test_what_the_reader_says_of_frames_is_understood() -> None:
    path = Path("clip.mp4")
    whole = list(module._captured(Capture([True] * 4, [0, 40, 80, 0]), path, cv2.CAP_PROP_POS_MSEC))
    assert [time_s for _, time_s in whole] == pytest.approx([0, 0.04, 0.08, 0.12]), "OpenCV 4.6 gives 0 at the end"
    with pytest.raises(FormatError, match=r"clip\.mp4: frame 2 is damaged"):
        list(module._captured(Capture([True, True, False, True], [0, 40, 80]), path, cv2.CAP_PROP_POS_MSEC))
    with pytest.raises(FormatError, match="time runs backwards"):
        list(module._captured(Capture([True] * 3, [0, 80, 40]), path, cv2.CAP_PROP_POS_MSEC))


def test_a_list_of_other_files_is_no_video(tmp_path: Path) -> None:
    write_video(tmp_path / "inner.mp4", moving_square(4), 25)
    (tmp_path / "list.mp4").write_text("ffconcat version 1.0\n" + "file inner.mp4\n" * 4)
    with pytest.raises(FormatError, match=r"list\.mp4: not a video that OpenCV reads: no AVI"):
        read_frames(tmp_path / "list.mp4")


def test_frames_and_pictures_beyond_the_limit_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_video(tmp_path / "clip.mp4", moving_square(6), 25)
    (tmp_path / "folder").mkdir()
    for number in range(6):
        write_image(tmp_path / "folder" / f"{number}.png", moving_square(1)[0])
    monkeypatch.setattr(module, "MAX_CLIP_BYTES", 4 * 48 * 64 * 3)
    for path in (tmp_path / "clip.mp4", tmp_path / "folder"):
        with pytest.raises(FormatError, match="frames take more than"):
            read_frames(path)
    assert len(read_frames(tmp_path / "clip.mp4", max_frames=4).frames) == 4


@pytest.mark.parametrize("suffix", [".webp", ".tiff", ".ppm"])
def test_pictures_whose_size_is_not_looked_at_are_refused(tmp_path: Path, suffix: str) -> None:
    ok, data = cv2.imencode(suffix, moving_square(1)[0])
    assert ok
    path = tmp_path / "picture.png"
    path.write_bytes(data.tobytes())
    with pytest.raises(FormatError, match="no PNG, JPEG or BMP"):
        read_image(path)


def encoded(format_name: str, subtype: str) -> bytes:
    soundfile = pytest.importorskip("soundfile")
    if subtype not in soundfile.available_subtypes(format_name):
        pytest.skip(f"this libsndfile writes no {subtype}")
    out = io.BytesIO()
    samples = 0.1 * np.sin(0.05 * np.arange(48000))
    soundfile.write(out, samples.astype(np.float32), 16000, format=format_name, subtype=subtype)
    return out.getvalue()


@pytest.mark.parametrize(
    ("suffix", "format_name", "subtype"),
    [(".mp3", "MP3", "MPEG_LAYER_III"), (".aiff", "AIFF", "PCM_16"), (".opus", "OGG", "OPUS")],
)
def test_a_cut_sound_file_gives_what_it_holds_and_says_so(
    tmp_path: Path, suffix: str, format_name: str, subtype: str
) -> None:
    data = encoded(format_name, subtype)
    path = tmp_path / f"a{suffix}"
    path.write_bytes(data)
    assert read_audio(path).notes == []
    path.write_bytes(data[: len(data) // 2])
    cut = read_audio(path)
    assert len(cut.samples) < 30000
    assert any("ends early or is damaged" in note for note in cut.notes)


def test_flac_of_unknown_length_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = bytearray(encoded("FLAC", "PCM_16"))
    data[21] &= 0xF0  # the 36 bits of the number of samples in STREAMINFO
    data[22:26] = bytes(4)
    path = tmp_path / "a.flac"
    path.write_bytes(data)
    audio = read_audio(path)
    assert len(audio.samples) == 48000 and audio.notes == []
    monkeypatch.setattr("hri.media.audio._MAX_SAMPLES", 40000)
    with pytest.raises(FormatError, match="more than 40000 samples"):
        read_audio(path)


@pytest.mark.parametrize("suffix", [".mp4", ".avi", ".webm"])
def test_a_video_of_odd_size_keeps_all_of_its_picture(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"clip{suffix}"
    frames = moving_square(5, height=77, width=101)
    write_video(path, frames, 25)
    clip = read_frames(path)
    assert clip.frames[0].shape == (78, 102, 3) and len(clip.frames) == 5
    difference = np.abs(clip.frames[0][:77, :101].astype(int) - frames[0])
    assert difference.mean() < 30


def test_a_video_that_is_closed_takes_no_frames(tmp_path: Path) -> None:
    frames = moving_square(3)
    with VideoWriter(tmp_path / "a.avi", 25) as writer:
        for frame in frames:
            writer.write(frame)
        writer.close()
        writer.close()
        with pytest.raises(InvalidArgument, match="the video is closed"):
            writer.write(frames[0])
    assert len(read_frames(tmp_path / "a.avi").frames) == 3
    with VideoWriter(tmp_path / "b.avi", 25) as writer:
        writer.write(frames[0])
        writer.discard()
    assert [path.name for path in tmp_path.iterdir()] == ["a.avi"]


def test_slow_video_has_its_own_rate(tmp_path: Path) -> None:
    write_video(tmp_path / "clip.avi", moving_square(4), 0.5)
    assert frame_rate(tmp_path / "clip.avi") == pytest.approx(0.5)


@pytest.mark.parametrize(
    "image",
    [
        np.zeros((0, 5), np.uint8),
        np.zeros((5, 5, 2), np.uint8),
        np.zeros((5, 5, 3), np.float64),
        np.zeros((5, 5), bool),
        np.zeros(5, np.uint8),
    ],
)
def test_an_array_that_is_no_picture_is_refused(tmp_path: Path, image: Any) -> None:
    with pytest.raises(InvalidArgument, match=r"a\.png: an array of shape .* is no picture"):
        write_image(tmp_path / "a.png", image)
    with pytest.raises(InvalidArgument, match="is no picture"):
        encode_png(image)
    assert not list(tmp_path.iterdir())


def test_names_that_no_file_can_have_are_io_errors(tmp_path: Path) -> None:
    name = tmp_path / ("x" * 300 + ".wav")
    assert kind_of_file(name) == "a sound file"
    for read in (read_audio, read_frames):
        with pytest.raises((IoError, FormatError)):
            read(name)


def test_numbers_in_names_are_compared_at_any_length() -> None:
    names = ["take" + "9" * 5000, "take10", "take2", "take02", "take०3", "b", "take"]
    assert sorted(names, key=natural_key) == ["b", "take", "take02", "take2", "take०3", "take10", "take" + "9" * 5000]
