# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Every option of synthetic signers changes what it says, and nothing is drawn that cannot be."""

from __future__ import annotations

import tomllib
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from hri.core.errors import InvalidArgument
from hri.datasets import Dataset
from hri.media import read_frames
from hri.synthetic.drawing.options import BACKGROUNDS, LIGHTS, SKINS, SLEEVES
from hri.synthetic.signer import SignerOptions, draw_clip, draw_still, make_gesture_corpus, make_signer

WALL = (210.0, 200.0, 190.0)
CLEAN = {"noise": 0.0, "exposure": 1.0, "cast": (1.0, 1.0, 1.0), "vignette": 0.0, "wall": WALL}


def still(index: int = 3, label: str = "5", **asked: object) -> NDArray[np.int64]:
    """A close-up in a clean picture, but for what is asked for."""
    return draw_still(make_signer(index, options=SignerOptions(**{**CLEAN, **asked})), label).astype(int)  # type: ignore[arg-type]


def hand(picture: NDArray[np.int64]) -> NDArray[np.bool_]:
    """What is redder than the wall, well inside its outline."""
    red = (picture[..., 2] - picture[..., 0] > 12).astype(np.uint8)
    return cv2.erode(red, np.ones((5, 5), np.uint8)) > 0


def test_nothing_asked_for_is_the_person_as_before() -> None:
    np.testing.assert_array_equal(
        draw_still(make_signer(2), "4"), draw_still(make_signer(2, options=SignerOptions()), "4")
    )


def test_skins_are_told_apart_and_the_wall_stays() -> None:
    pictures = {skin: still(skin=skin) for skin in SKINS}
    tones = {skin: np.median(picture[hand(picture)], axis=0) for skin, picture in pictures.items()}
    by_tone = sorted(SKINS, key=lambda skin: sum(SKINS[skin]))
    assert sorted(tones, key=lambda skin: float(tones[skin].sum())) == by_tone
    assert tones["pale"].sum() > 1.5 * tones["dark"].sum()
    for picture in pictures.values():
        np.testing.assert_array_equal(picture[:20, :20], pictures["tan"][:20, :20])


def test_shorter_sleeves_bare_more_skin() -> None:
    bare = [int(hand(still(sleeve=sleeve, zoom=0.6)).sum()) for sleeve in SLEEVES]
    assert bare == sorted(bare) and bare[1] > bare[0] and bare[2] > 1.1 * bare[1]
    clips = {
        sleeve: draw_clip(make_signer(3, options=SignerOptions(sleeve=sleeve, **CLEAN)), "5", num_frames=5)[2]
        for sleeve in SLEEVES
    }
    skin = [int(hand(frame[:, :120].astype(int)).sum()) for frame in clips.values()]
    assert skin == sorted(skin) and skin[3] > 1.3 * skin[0]


def test_light_comes_from_where_it_is_asked_for() -> None:
    def lit(light: str) -> tuple[float, float]:
        """How much brighter fingers are on their left than on their right, and the hand above than below."""
        picture = still(light=light)
        level, inside = picture.sum(axis=2), hand(picture)
        return ratio(level[30:90], inside[30:90]), ratio(level.T, inside.T)

    def ratio(level: NDArray[np.int64], inside: NDArray[np.bool_]) -> float:
        """Of the first thirds of runs to their last thirds, row by row."""
        first, last = [], []
        for values, where in zip(level, inside, strict=True):
            for run in np.split(np.flatnonzero(where), np.flatnonzero(np.diff(np.flatnonzero(where)) > 1) + 1):
                if len(run) >= 6:
                    first.append(values[run[: len(run) // 3]].mean())
                    last.append(values[run[-(len(run) // 3) :]].mean())
        return float(np.mean(first) / np.mean(last))

    (left, _), (right, _), (_, above), (_, soft) = (lit(name) for name in ("left", "right", "above", "soft"))
    assert left > 1.1 > 0.95 > right and above > soft
    spread = {name: still(light=name)[hand(still(light=name))].sum(axis=1).std() for name in ("soft", "hard")}
    assert spread["hard"] > 1.3 * spread["soft"]
    assert len(LIGHTS) == 5


def test_backgrounds_are_drawn() -> None:
    plain = still(background="plain")
    for background in BACKGROUNDS:
        picture = still(background=background)
        changed = np.abs(picture - plain).sum(axis=2) > 20
        assert (changed.any() and not changed[100:160, :60].any()) == (background != "plain")
    red_wall = still(wall=(60.0, 60.0, 220.0))
    assert red_wall[5, 5, 2] > 2.5 * red_wall[5, 5, 0]


def test_exposure_cast_noise_and_corners() -> None:
    normal = still()
    np.testing.assert_allclose(still(exposure=0.5)[5:50, 5:50], 0.5 * normal[5:50, 5:50], atol=1.1)
    warm = still(cast=(0.5, 1.0, 1.2))[5:50, 5:50]
    np.testing.assert_allclose(warm[..., 0], 0.5 * normal[5:50, 5:50, 0], atol=1.1)
    np.testing.assert_allclose(warm[..., 2], np.minimum(255, 1.2 * normal[5:50, 5:50, 2]), atol=1.6)
    assert (still(noise=12.0) - normal)[5:50, 5:50].std() == pytest.approx(12.0, rel=0.05)
    dark = still(vignette=0.8)
    assert dark[2, 2].sum() < 0.35 * normal[2, 2].sum() and dark[100, 100].sum() > 0.95 * normal[100, 100].sum()


def test_the_camera_moves_and_goes_out_of_focus() -> None:
    def sharpness(picture: NDArray[np.int64]) -> float:
        return float(cv2.Laplacian(picture.astype(np.float32), cv2.CV_32F).std())

    normal = still()
    assert sharpness(still(blur_px=3.0)) < 0.4 * sharpness(normal)
    assert hand(still(zoom=1.5)).sum() > 1.2 * hand(normal).sum() > 1.2 * hand(still(zoom=0.7)).sum()
    np.testing.assert_allclose(still(shift_x=0.1)[:, 20:], normal[:, :-20], atol=1)
    np.testing.assert_allclose(still(shift_y=-0.1)[:-20], normal[20:], atol=1)
    turned = still(roll_deg=20.0)
    back = cv2.warpAffine(turned.astype(np.float32), cv2.getRotationMatrix2D((100, 100), 20.0, 1.0), (200, 200))
    assert np.abs(back - normal)[60:140, 60:140].mean() < 0.3 * np.abs(turned - normal)[60:140, 60:140].mean()


def test_rate_and_tempo_of_clips(tmp_path: Path) -> None:
    def frames(**asked: float) -> list[NDArray[np.uint8]]:
        return draw_clip(make_signer(1, options=SignerOptions(**asked)), "5", size_px=(96, 72))

    assert (len(frames()), len(frames(fps=30.0)), len(frames(tempo=2.0)), len(frames(fps=10.0))) == (36, 72, 18, 24)
    # The same movement in half the frames: the first of every two.
    quick, usual = (np.array(frames(tempo=tempo, noise=0.0)).mean(axis=(1, 2, 3)) for tempo in (2.0, 1.0))
    assert np.corrcoef(quick, np.interp(np.linspace(0, 1, 18), np.linspace(0, 1, 36), usual))[0, 1] > 0.95
    made = make_gesture_corpus(tmp_path, ["1"], 1, kind="clip", options=SignerOptions(fps=30.0, tempo=4.0))
    clip = read_frames(made.samples[0].path)
    assert len(clip.frames) == 18 and clip.fps == pytest.approx(30.0, rel=0.01)


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"skin": "green"}, "skin is 'green', must be one of tan"),
        ({"sleeve": "none"}, "sleeve"),
        ({"light": "moon"}, "light"),
        ({"background": "sea"}, "background"),
        ({"wall": (1.0, 2.0, 300.0)}, "wall"),
        ({"cast": (1.0, 2.5, 1.0)}, "cast"),
        ({"exposure": 0.0}, "exposure is 0.0, must lie in 0.05..4"),
        ({"tempo": float("nan")}, "tempo"),
        ({"fps": 1.0}, "fps"),
        ({"zoom": 9.0}, "zoom"),
    ],
)
def test_what_cannot_be_drawn_is_named(asked: dict, message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        SignerOptions(**asked)


def test_the_command_makes_what_is_asked_for_and_says_so(hri, tmp_path: Path) -> None:
    out = tmp_path / "signs"
    reported = hri("corpus", "gesture", "1", "7", "--out", out, "--persons", 2, "--first-person", 5, "--skin", "dark",
               "--cast", 0.5, 1, 1.2, "--noise", 9)  # fmt: skip
    assert reported.code == 0 and reported.out.startswith("4 synthetic pictures of 2 signs by 2 drawn people"), (
        reported.err
    )
    made = Dataset.load(out)
    assert made.synthetic and made.persons == ["signer06", "signer07"]
    manifest = tomllib.loads((out / "dataset.toml").read_text())
    stated = manifest["made_by"]
    assert stated["skin"] == "dark" and stated["cast"] == [0.5, 1.0, 1.2] and stated["first_person"] == 5
    assert "tempo" not in stated and manifest["synthetic"] is True
    asked = SignerOptions(skin="dark", cast=(0.5, 1.0, 1.2), noise=9.0)
    expected = draw_still(make_signer(5, options=asked), "7")
    path = next(s.path for s in made if s.label == "7" and s.person == "signer06")
    other = draw_still(make_signer(6, options=asked), "7")
    apart = [np.abs(read_frames(path).frames[0].astype(int) - picture).mean() for picture in (expected, other)]
    assert apart[0] < 9 < 12 < apart[1]  # JPEG smooths noise
    assert hri("corpus", "gesture", "--out", out, "--zoom", 7).code == 2
    assert hri("corpus", "gesture", "wave", "--out", tmp_path / "no").code == 3
