# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""`hri hands`: what is found of the hand in a clip, as a table and a film."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import drawn_hands
from hri.core.errors import FormatError, InvalidArgument
from hri.features.hand import hand_column_names, hand_features
from hri.media import Clip, read_frames, read_pictures, write_image, write_video
from hri.vision import hands, landmarks
from hri.vision.film import HandFilm, film_hands
from hri.vision.hands import find_silhouettes
from hri.vision.report import inspect_hands

FPS = drawn_hands.FPS


@pytest.fixture
def clip() -> Clip:
    frames = drawn_hands.shown(["flat"])
    return Clip(frames, [i / FPS for i in range(len(frames))], Path("flat.avi"))


def test_every_frame_has_a_row_and_rows_hold_what_the_frame_has(clip: Clip) -> None:
    steps: list[tuple[int, int]] = []
    report = inspect_hands(clip, kind="fourier", num_harmonics=4, progress=lambda *done: steps.append(done))
    found = find_silhouettes(clip.frames)
    assert steps == [(i + 1, len(clip.frames)) for i in range(len(clip.frames))]
    assert [hand.found for hand in report.hands["hand"]] == [bool(s.mask.any()) for s in found]
    assert 10 < sum(hand.found for hand in report.hands["hand"]) < len(clip.frames)
    expected = iter(hand_features([s.grey for s in found], [s.mask for s in found], "fourier", num_harmonics=4))
    place = ["frame", "time_s", "quality", "repaired", "centre_x", "centre_y", "area"]
    assert report.columns == [*place, *hand_column_names("fourier", num_harmonics=4)]
    for number, (row, shape) in enumerate(zip(report.rows(), found, strict=True)):
        assert row[:3] == [number, clip.times_s[number], shape.quality if shape.mask.any() else 0.0]
        if not shape.mask.any():
            assert row[3:] == [0] + [None] * (len(report.columns) - 4)
            continue
        down, across = np.nonzero(shape.mask)
        assert row[4:7] == pytest.approx([(across.mean() + 0.5) / 160, (down.mean() + 0.5) / 160, len(down) / 160**2])
        np.testing.assert_array_equal(np.float32(row[7:]), next(expected))


def test_tracks_are_told_the_rate_of_the_clip(clip: Clip) -> None:
    slow = Clip(clip.frames, [2 * t for t in clip.times_s], clip.path)
    speed = inspect_hands(clip).names.index("speed")
    fast, half = (
        [h.features[speed] for h in inspect_hands(c).hands["hand"] if h.features is not None] for c in (clip, slow)
    )
    assert max(fast) > 0.5
    np.testing.assert_allclose(np.array(fast), 2 * np.array(half), rtol=1e-5)


def test_films_show_the_hand_and_follow_the_clip(clip: Clip, tmp_path: Path) -> None:
    report = inspect_hands(clip)
    film = HandFilm(report)
    with_hand = next(i for i, hand in enumerate(report.hands["hand"]) if hand.area and hand.area > 0.05)
    drawn, bare = film.draw(with_hand), film.draw(0)
    assert drawn.shape == bare.shape and drawn.shape[1] == 480 and drawn.shape[0] > 480
    mask = np.kron(report.hands["hand"][with_hand].mask, np.ones((3, 3))) > 0
    mask[:, :250] = mask[:120] = False  # numbers and edges are drawn there
    green = drawn[:480, :, 1].astype(int) - drawn[:480, :, 2]
    seen = clip.frames[with_hand].repeat(3, axis=0).repeat(3, axis=1).astype(int)
    before = seen[..., 1] - seen[..., 2]
    assert mask.sum() > 1000 and np.mean(green[mask] > before[mask] + 20) > 0.9
    # The quality of frames with a hand is drawn below, and none where there is none.
    strip = drawn[480:530]
    columns = (np.array([0.5, with_hand + 0.5]) * 480 / len(clip.frames)).astype(int) + 1
    lit = [(strip[:, column] == (80, 220, 80)).all(axis=1).sum() for column in columns]
    assert lit[0] == 0 and lit[1] > 10
    film_hands(report, tmp_path / "seen.avi")
    written = read_frames(tmp_path / "seen.avi")
    assert len(written.frames) == len(clip.frames) and written.frames[0].shape == drawn.shape
    assert written.fps == pytest.approx(FPS, rel=1e-3)


def test_one_picture_and_odd_sizes_are_filmed(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    picture = drawn_hands.picture("tall", 0.5, rng)[:157, :151]
    report = inspect_hands(Clip([picture], [0.0], Path("tall.png")), kind="hand")
    assert report.hands["hand"][0].found and len(report.names) > 3000
    film_hands(report, tmp_path / "tall.mp4")
    assert len(read_frames(tmp_path / "tall.mp4").frames) == 1


def test_landmarks_are_reported_too(clip: Clip, monkeypatch: pytest.MonkeyPatch) -> None:
    joints = np.random.default_rng(0).uniform(20, 90, (21, 2)).astype(np.float32)
    half_out = joints - np.float32([55.0, 0.0])

    class Tracker:
        """As MediaPipe's: no hand first, then one, then one that leaves the picture."""

        def __init__(self, **_: object) -> None:
            self.given = iter([None, joints, half_out])

        def __enter__(self) -> Tracker:
            return self

        def __exit__(self, *_: object) -> None: ...

        def process(self, picture: np.ndarray) -> SimpleNamespace:
            found = next(self.given)
            if found is None:
                return SimpleNamespace(multi_hand_landmarks=None)
            points = [SimpleNamespace(x=x / 160, y=y / 160) for x, y in found]
            return SimpleNamespace(multi_hand_landmarks=[SimpleNamespace(landmark=points)])

    mediapipe = SimpleNamespace(solutions=SimpleNamespace(hands=SimpleNamespace(Hands=Tracker)))
    monkeypatch.setattr(landmarks, "import_optional", lambda *_: mediapipe)
    short = Clip(clip.frames[:3], clip.times_s[:3], clip.path)
    report = inspect_hands(short, "landmarks")
    assert [hand.found for hand in report.hands["hand"]] == [False, True, True]
    assert report.hands["hand"][1].quality == 1.0 > report.hands["hand"][2].quality > 0.1
    np.testing.assert_allclose(report.hands["hand"][1].joints, joints, rtol=1e-5)
    assert len(report.names) == len(report.hands["hand"][1].features) == 85 and report.names[-3:] == [
        "x",
        "y",
        "log_area",
    ]
    film = HandFilm(report)
    assert not np.array_equal(film.draw(1)[:480], film.draw(0)[:480])
    with pytest.raises(TypeError, match="delta_orders"):
        inspect_hands(short, "landmarks", delta_orders=1)
    with pytest.raises(InvalidArgument, match="source"):
        inspect_hands(short, "depth")  # type: ignore[arg-type]


def test_the_command_writes_film_and_tables(hri, clip: Clip, tmp_path: Path) -> None:
    video, film, table, values = (tmp_path / name for name in ("flat.avi", "seen.mp4", "seen.csv", "seen.json"))
    write_video(video, clip.frames, FPS)
    reported = hri("hands", video, "--video", film, "-o", table, "--option", "delta_orders=0")
    assert reported.code == 0, reported.err
    assert reported.out == "" and f"of {len(clip.frames)} frames" in reported.err
    assert len(read_frames(film).frames) == len(clip.frames)
    rows = np.genfromtxt(table, delimiter=",", names=True)
    assert len(rows) == len(clip.frames) and rows.dtype.names[-1] == "move_sine"
    assert np.isnan(rows["speed"][0]) and rows["quality"][0] == 0 and np.nanmax(rows["speed"]) > 0.5
    assert hri("hands", video, "-o", values, "--option", "delta_orders=0").code == 0
    stored = json.loads(values.read_text())
    assert [f["quality"] for f in stored["frames"]] == pytest.approx(rows["quality"].tolist())
    assert stored["frames"][0]["features"] is None and stored["kind"] == "track"
    printed = hri("hands", video, "--kind", "moments").out.splitlines()
    assert printed[0].split("\t")[-1] == "hu7" and len(printed) == 1 + len(clip.frames)


def test_folders_of_pictures_are_clips_in_the_order_of_their_numbers(hri, clip: Clip, tmp_path: Path) -> None:
    folder = tmp_path / "pictures"
    folder.mkdir()
    for number, frame in enumerate(clip.frames[8:20]):
        write_image(folder / f"p{number}.png", frame)
    (folder / "notes.txt").touch()
    read = read_pictures(folder, 15.0)
    np.testing.assert_array_equal(read.frames, clip.frames[8:20])
    assert read.times_s[3] == pytest.approx(0.2) and read.fps == pytest.approx(15.0)
    reported = hri("hands", folder, "--fps", 15)
    assert reported.code == 0 and len(reported.out.splitlines()) == 13
    write_image(folder / "p99.png", clip.frames[0][:100])
    with pytest.raises(FormatError, match=r"p99.png: 160 x 100, but p0.png is 160 x 160"):
        read_pictures(folder)
    with pytest.raises(InvalidArgument, match="fps"):
        read_pictures(folder, 0.0)
    with pytest.raises(FormatError, match="no pictures"):
        read_pictures(tmp_path)


def _before_a_board() -> list[np.ndarray]:
    """Something of the colour of skin that moves, before a board of that colour."""
    room = np.full((240, 320, 3), (165, 160, 150), np.uint8)
    room[20:220, 200:290] = (110, 135, 195)
    frames = [room.copy() for _ in range(12)]
    for t, frame in enumerate(frames):
        frame[60:120, 10 + 12 * t : 50 + 12 * t] = (110, 135, 195)
    return frames


def test_a_known_background_is_left_out(hri, tmp_path: Path) -> None:
    frames = _before_a_board()
    place = hands.background_of(frames)
    assert (place[20:220, 200:290] == (110, 135, 195)).all() and (place[60:120, 20:190] == (165, 160, 150)).all()
    clip = Clip(frames, [i / 12 for i in range(12)], Path("board.avi"))
    for number, hand in enumerate(inspect_hands(clip, background=place).hands["hand"]):
        assert hand.found and hand.x == pytest.approx((30 + 12 * number) / 320, abs=0.02)
    with pytest.raises(InvalidArgument, match="320 x 240 pixels, the background 320 x 100"):
        find_silhouettes(frames, background=place[:100])
    with pytest.raises(InvalidArgument, match="one size"):
        hands.background_of([frames[0], frames[0][:100]])
    with pytest.raises(InvalidArgument, match="one size"):
        hands.background_of([])

    write_video(tmp_path / "board.mp4", frames, 12)
    write_image(tmp_path / "room.png", place)
    for arguments in (["--background", "clip"], ["--background", str(tmp_path / "room.png"), "--method", "hsv_wide"]):
        ran = hri("hands", tmp_path / "board.mp4", *arguments, "-o", tmp_path / "seen.json")
        assert ran.code == 0, ran.err
        seen = json.loads((tmp_path / "seen.json").read_text())["frames"]
        middles = [row["centre_x"] for row in seen]
        assert middles == pytest.approx([(30 + 12 * t) / 320 for t in range(12)], abs=0.03)


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["--kind", "fourier", "--source", "landmarks"], 2, "--kind"),
        (["--fps", "10"], 2, "--fps"),
        (["--method", "hsv_wide", "--source", "landmarks"], 2, "--method"),
        (["--background", "missing.png"], 3, "missing.png"),
        (["--option", "delta_order=1"], 3, "delta_order"),
        (["--option", "delta_orders=9"], 3, "delta_orders"),
        (["--video", "seen.gif"], 2, ".mp4"),
        (["-o", "seen.npy"], 2, ".csv"),
    ],
)
def test_what_cannot_be_is_said(hri, clip: Clip, tmp_path: Path, arguments: list[str], code: int, message: str) -> None:
    write_video(tmp_path / "flat.avi", clip.frames[:3], FPS)
    reported = hri("hands", tmp_path / "flat.avi", *arguments)
    assert reported.code == code and message in reported.err
