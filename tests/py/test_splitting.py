# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Splitting of sentences at pauses of the pictures: the baseline of the thesis, and its study."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from drawn_hands import FPS, picture
from hri.core.errors import InvalidArgument
from hri.media import write_video
from hri.studies import sentence_splitting
from hri.studies.gesture_sentences import GestureClip, join
from hri.vision.splitting import SIZE, direction_changes, key_frames, split_at_pauses, subsample


def filmed(moves: list[int]) -> NDArray[np.float32]:
    """A square that goes to the right by so many pixels from picture to picture."""
    pictures = []
    for x in np.cumsum([0, *moves]):
        picture = np.zeros((80, 240), np.float32)
        picture[20:50, 10 + x : 40 + x] = np.linspace(50, 200, 30)
        pictures.append(subsample(picture))
    return np.stack(pictures)


def test_subsampling_takes_means_of_blocks() -> None:
    picture = np.random.default_rng(1).uniform(0, 255, (480, 640)).astype(np.float32)
    expected = picture.reshape(40, 12, 640).mean(axis=1)
    small = subsample(picture)
    assert small.shape == SIZE
    edges = np.arange(61) * 640 // 60
    expected = np.stack([expected[:, a:b].mean(axis=1) for a, b in pairwise(edges)], axis=1)
    np.testing.assert_allclose(small, expected, rtol=1e-3)
    np.testing.assert_allclose(subsample(np.full((20, 30), 7.0)), np.full(SIZE, 7.0), rtol=1e-5)
    with pytest.raises(InvalidArgument, match="shape"):
        subsample(np.zeros((4, 4, 3)))


def test_a_sentence_is_split_where_the_picture_stands_still() -> None:
    pictures = filmed([0] * 6 + [3] * 20 + [0] * 8 + [3] * 25 + [0] * 6)
    changes = direction_changes(pictures, per_pixel=True)
    assert changes.shape == (len(pictures) - 1,) and (changes[:5] == 0).all() and (changes[8:24] > 0).all()
    parts = split_at_pauses(changes, 0.05)
    assert len(parts) == 2
    for (first, last), (begun, ended) in zip(parts, [(6, 27), (34, 60)], strict=True):
        assert abs(first - begun) <= 2 and abs(last - ended) <= 2
    assert split_at_pauses(changes, 0.05, min_pause=9) == [(0, len(pictures))]
    assert split_at_pauses(changes, 0.05, min_part=30) == []
    assert split_at_pauses(direction_changes(pictures[:1])) == []
    mean = direction_changes(pictures)
    assert (mean[:5] == 0).all() and mean.shape == changes.shape


def test_joined_clips_never_stand_quite_still() -> None:
    rng = np.random.default_rng(0)
    clips = [GestureClip(str(i), "c", rng.normal(size=(20 + i, 5)).astype(np.float32), Path(str(i))) for i in range(3)]
    shown = {clip.path: rng.uniform(0, 255, (len(clip.rows), *SIZE)).astype(np.float32) for clip in clips}
    paths = [clip.path for clip in clips]
    for gaps in ([0, 0], [5, 15]):
        sentence = join(clips, gaps)
        for way in sentence_splitting.CHANGES:
            changes = sentence_splitting._Changes(shown, way).of(sentence, paths)
            assert len(changes) == len(sentence.rows) - 1 and changes.min() > 0
    together = direction_changes(np.concatenate([shown[path] for path in paths]))
    way = sentence_splitting.CHANGES[0]
    np.testing.assert_allclose(sentence_splitting._Changes(shown, way).of(join(clips, [0, 0]), paths), together)


def test_key_frames_are_those_in_the_middle() -> None:
    assert key_frames((10, 40)) == (17, 32) and key_frames((0, 16)) == (0, 15) and key_frames((3, 9)) == (3, 9)


def test_what_is_no_film_is_refused() -> None:
    with pytest.raises(InvalidArgument, match="2 x 2"):
        direction_changes(np.zeros((4, 1, 5)))
    for changes in ([[1.0]], [np.nan], [-1.0]):
        with pytest.raises(InvalidArgument, match="changes"):
            split_at_pauses(changes)
    with pytest.raises(InvalidArgument, match="share is 2"):
        split_at_pauses([1.0, 2.0], share=2.0)


def test_the_command_line_splits_a_film(hri, tmp_path: Path) -> None:
    film = tmp_path / "film.avi"
    rng = np.random.default_rng(3)
    # The wall, and the hand: it waves twice, and holds between.
    wave = [0.5 + 0.2 * np.sin(0.5 * step) for step in range(30)]
    write_video(film, [picture("flat", height, rng) for height in [*wave, *[wave[-1]] * 20, *wave[::-1]]], FPS)
    lines = [line.split("\t") for line in hri("split", film, "--share", "0.3").out.splitlines()]
    assert len(lines) == 2
    (first, last, middle, end), (begin, *_) = ([int(cell) for cell in line[:4]] for line in lines)
    assert first == 0 and abs(last - 30) <= 4 and abs(begin - 50) <= 4 and end - middle == 15
    assert float(lines[1][4]) == pytest.approx(begin / FPS, abs=0.02)
    found = json.loads(hri("split", film, "--share", "0.3", "--json", "-").out)
    assert [part["frames"][0] for part in found["parts"]] == [first, begin] and found["num_frames"] == 80
    assert len(hri("split", film, "--share", "0.3", "--min-pause", "40").out.splitlines()) == 1
    (tmp_path / "text.avi").write_text("no film")
    refused = hri("split", tmp_path / "text.avi")
    assert refused.code == 3 and "text.avi" in refused.err
