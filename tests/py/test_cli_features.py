# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""`hri features` and `hri.features`."""

from __future__ import annotations

from pathlib import Path

import cv2
import librosa
import numpy as np
import pytest

from conftest import RATE_HZ, tone_word
from hri import _native
from hri.errors import InvalidArgument
from hri.features import cepstra, cepstra_options, column_names


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    path = tmp_path / "word.wav"
    _native.write_wav_pcm16(str(path), tone_word(500, 0, 0), RATE_HZ)
    return path


def test_tables_and_arrays_hold_the_same(hri, recording: Path, tmp_path: Path):
    printed = hri("features", recording, "--kind", "hfcc")
    assert printed.code == 0
    header, *lines = printed.out.splitlines()
    assert header.split("\t")[:2] == ["c0", "c1"] and header.split("\t")[-1] == "dd_c12"
    rows = np.array([[float(v) for v in line.split("\t")] for line in lines], dtype="f4")
    samples = _native.read_wav(str(recording)).samples
    np.testing.assert_array_equal(rows, cepstra(samples, RATE_HZ, "hfcc"))

    table, array = tmp_path / "new" / "word.csv", tmp_path / "word.npy"
    assert hri("features", recording, "--kind", "hfcc", "-o", table).out == ""
    np.testing.assert_array_equal(np.loadtxt(table, delimiter=",", skiprows=1, dtype="f4"), rows)
    assert hri("features", recording, "--kind", "hfcc", "-o", array).code == 0
    np.testing.assert_array_equal(np.load(array), rows)


def test_a_preset_is_the_other_program(hri, recording: Path, tmp_path: Path):
    out, plot = tmp_path / "word.npy", tmp_path / "word.png"
    told = hri("features", recording, "--preset", "librosa", "-o", out, "--plot", plot)
    assert told.code == 0 and "features" in told.err
    expected = librosa.feature.mfcc(y=np.asarray(_native.read_wav(str(recording)).samples), sr=RATE_HZ).T
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
