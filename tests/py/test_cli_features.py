# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""`hri features`, of sound and of hands, and `hri.features`."""

from __future__ import annotations

from pathlib import Path

import cv2
import librosa
import numpy as np
import pytest

import drawn_hands
from conftest import RATE_HZ, tone_word
from hri.core.errors import InvalidArgument
from hri.features import cepstra, cepstra_options, column_names
from hri.features.hand import hand_column_names, hand_features
from hri.io import read_wav, write_wav_pcm16
from hri.media import read_image, write_image, write_video
from hri.synthetic.drawing.signer import make_signer
from hri.synthetic.signer import draw_still
from hri.vision.hands import find_silhouettes


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    path = tmp_path / "word.wav"
    write_wav_pcm16(str(path), tone_word(500, 0, 0), RATE_HZ)
    return path


def test_tables_and_arrays_hold_the_same(hri, recording: Path, tmp_path: Path):
    printed = hri("features", recording, "--kind", "hfcc")
    assert printed.code == 0
    header, *lines = printed.out.splitlines()
    assert header.split("\t")[:2] == ["c0", "c1"] and header.split("\t")[-1] == "dd_c12"
    rows = np.array([[float(v) for v in line.split("\t")] for line in lines], dtype="f4")
    samples = read_wav(str(recording)).samples
    np.testing.assert_array_equal(rows, cepstra(samples, RATE_HZ, "hfcc"))

    table, array = tmp_path / "new" / "word.csv", tmp_path / "word.npy"
    assert hri("features", recording, "--kind", "hfcc", "-o", table).out == ""
    np.testing.assert_array_equal(np.loadtxt(table, delimiter=",", skiprows=1, dtype="f4"), rows)
    assert hri("features", recording, "--kind", "hfcc", "-o", array).code == 0
    np.testing.assert_array_equal(np.load(array), rows)


def test_a_preset_is_the_other_program(hri, recording: Path, tmp_path: Path):
    out, plot = tmp_path / "word.npy", tmp_path / "word.png"
    reported = hri("features", recording, "--preset", "librosa", "-o", out, "--plot", plot)
    assert reported.code == 0 and "features" in reported.err
    expected = librosa.feature.mfcc(y=np.asarray(read_wav(str(recording)).samples), sr=RATE_HZ).T
    np.testing.assert_allclose(np.load(out), expected, rtol=1e-4, atol=1e-2)
    assert cv2.imread(str(plot)).shape[1] > 500


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["--option", "num_filter=3"], 3, "num_filter"),
        (["--option", "num_cepstra=99"], 3, "num_cepstra"),
        (["--kind", "plp"], 2, "plp"),
        (["-o", "word.txt"], 2, ".csv"),
    ],
)
def test_what_cannot_be_is_said(hri, recording: Path, arguments: list[str], code: int, message: str):
    result = hri("features", recording, *arguments)
    assert result.code == code and message in result.err


def test_names_of_columns_follow_the_options():
    assert column_names(cepstra_options(16000, preset="htk", num_cepstra=2)) == ["c1", "c2", "c0"]
    assert column_names(cepstra_options(16000, preset="kaldi", num_cepstra=1)) == ["energy", "c1"]
    names = column_names(cepstra_options(16000, "lpcc", num_cepstra=1, use_c0=False, delta_orders=1))
    assert names == ["c1", "d_c1"]


def test_kinds_that_there_are_not_are_refused():
    with pytest.raises(InvalidArgument, match="kind"):
        cepstra_options(16000, "plp")
    with pytest.raises(InvalidArgument, match="preset"):
        cepstra_options(16000, preset="sphinx")


@pytest.fixture
def sign(tmp_path: Path) -> Path:
    path = tmp_path / "sign.png"
    write_image(path, draw_still(make_signer(0), "3"))
    return path


def test_hands_in_pictures_have_features(hri, sign: Path, tmp_path: Path):
    shown = find_silhouettes([read_image(sign)])[0]
    for kind, options in (("hand", {}), ("fourier", {"num_harmonics": 4}), ("moments", {})):
        given = [part for name, value in options.items() for part in ("--option", f"{name}={value}")]
        printed = hri("features", sign, "--kind", kind, *given)
        assert printed.code == 0, printed.err
        header, *lines = printed.out.splitlines()
        assert header.split("\t") == hand_column_names(kind, **options)
        rows = np.array([[float(v) for v in line.split("\t")] for line in lines], dtype="f4")
        np.testing.assert_array_equal(rows, hand_features([shown.grey], [shown.mask], kind, **options))
    out, plot = tmp_path / "sign.npy", tmp_path / "sign.png.pdf"
    assert hri("features", sign, "-o", out, "--plot", plot).code == 0
    assert np.load(out).shape == (1, len(hand_column_names("hand"))) and plot.stat().st_size > 1000


def test_hands_in_videos_have_tracks(hri, tmp_path: Path):
    video, table, plot = tmp_path / "sign.avi", tmp_path / "sign.csv", tmp_path / "plot.png"
    write_video(video, drawn_hands.shown(["flat"]), drawn_hands.FPS)
    reported = hri("features", video, "--kind", "track", "-o", table, "--plot", plot)
    assert reported.code == 0 and "no hand, and so no row, in frames 0, 1" in reported.err
    found = np.genfromtxt(table, delimiter=",", names=True)
    assert 10 < len(found) < 60 and {"x", "speed", "d_log_area"} <= set(found.dtype.names)
    # Up and down again, faster than a picture's height in 2 s.
    assert found["speed"].max() > 0.5 and np.abs(found["x"] - 0.5).max() < 0.05
    assert cv2.imread(str(plot)).shape[1] > 500


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["--kind", "mfcc"], 2, "no features of kind mfcc; there are: hand"),
        (["--kind", "fourier", "--option", "num_harmonic=3"], 3, "--option"),
        (["--kind", "wavelet", "--option", "source=face"], 3, "source"),
        (["--kind", "chain-code", "--option", "num_parts=0"], 3, "num_parts"),
    ],
)
def test_what_a_picture_cannot_have_is_said(hri, sign: Path, arguments: list[str], code: int, message: str):
    result = hri("features", sign, *arguments)
    assert result.code == code and message in result.err


def test_a_picture_without_a_hand_and_sound_with_shapes_are_refused(hri, recording: Path, tmp_path: Path):
    write_image(tmp_path / "wall.png", np.full((240, 320, 3), (180, 170, 160), np.uint8))
    result = hri("features", tmp_path / "wall.png")
    assert result.code == 3 and "no hand is seen" in result.err
    result = hri("features", recording, "--kind", "fourier")
    assert result.code == 2 and "there are: mfcc" in result.err
