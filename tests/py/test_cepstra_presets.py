# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The presets give the numbers of librosa, of Kaldi (kaldi-native-fbank) and of the formulae of the HTK book."""

from __future__ import annotations

import kaldi_native_fbank as knf
import librosa
import numpy as np
import pytest

from hri._native import CepstraComputer, CepstraOptions


def voice(rate_hz: int, seconds: float = 1.0, seed: int = 0) -> np.ndarray:
    """Harmonics of a gliding tone with pauses, noise and an offset."""
    t = np.arange(int(seconds * rate_hz)) / rate_hz
    phase = 2 * np.pi * (120 * t + 40 * t**2)
    tone = sum(np.sin(h * phase) / h for h in range(1, 25))
    noise = np.random.default_rng(seed).normal(size=len(t))
    return (0.1 * tone * (np.sin(2 * np.pi * 3 * t) > -0.3) + 0.003 * noise + 0.01).astype("f4")


def assert_equal(ours: np.ndarray, theirs: np.ndarray) -> None:
    """To 1e-4 of the value, or of the mean size of that cepstrum where a value is near zero."""
    assert ours.shape == theirs.shape and ours.dtype == np.float32
    np.testing.assert_array_less(np.abs(ours - theirs), 1e-4 * np.maximum(np.abs(theirs), np.abs(theirs).mean(axis=0)))


def test_what_compares_them_sees_a_difference() -> None:
    x = np.ones((4, 3), dtype="f4")
    with pytest.raises(AssertionError):
        assert_equal(x * np.float32(1.0002), x)


@pytest.mark.parametrize("rate_hz", [8000, 16000, 22050, 44100])
def test_librosa(rate_hz: int) -> None:
    x = voice(rate_hz)
    ours = CepstraComputer(CepstraOptions.librosa(rate_hz)).compute(x)
    assert_equal(ours, librosa.feature.mfcc(y=x, sr=rate_hz).T)


@pytest.mark.parametrize("length", [400, 512])
def test_librosa_with_frames_of_its_own(length: int) -> None:
    x = voice(16000)
    options = CepstraOptions.librosa(16000)
    options.frame_length_ms, options.frame_shift_ms, options.fft_size = 1000 * length / 16000, 10, 512
    options.num_filters, options.num_cepstra, options.low_hz, options.high_hz = 40, 12, 50, 7000
    theirs = librosa.feature.mfcc(
        y=x, sr=16000, n_mfcc=13, n_fft=512, win_length=length, hop_length=160, n_mels=40, fmin=50, fmax=7000
    )
    assert_equal(CepstraComputer(options).compute(x), theirs.T)


def test_librosa_raises_what_is_far_below_the_loudest() -> None:
    x = voice(16000)
    x[6000:12000] = 0
    options = CepstraOptions.librosa(16000)
    expected = librosa.feature.mfcc(y=x, sr=16000).T
    assert_equal(CepstraComputer(options).compute(x), expected)
    options.top_db = 0
    assert np.abs(CepstraComputer(options).compute(x) - expected).max() > 1


def kaldi(x: np.ndarray, rate_hz: int, **changes: object) -> np.ndarray:
    options = knf.MfccOptions()
    options.frame_opts.dither = 0
    options.frame_opts.samp_freq = rate_hz
    for name, value in changes.items():
        part = options.mel_opts if hasattr(options.mel_opts, name) else options.frame_opts
        setattr(part if hasattr(part, name) else options, name, value)
    mfcc = knf.OnlineMfcc(options)
    mfcc.accept_waveform(rate_hz, (32768 * x).tolist())
    mfcc.input_finished()
    return np.stack([mfcc.get_frame(i) for i in range(mfcc.num_frames_ready)])


@pytest.mark.parametrize("rate_hz", [8000, 16000])
def test_kaldi(rate_hz: int) -> None:
    x = voice(rate_hz)
    assert_equal(CepstraComputer(CepstraOptions.kaldi(rate_hz)).compute(x), kaldi(x, rate_hz))


def test_kaldi_with_other_settings() -> None:
    x = voice(16000)
    options = CepstraOptions.kaldi()
    options.use_energy = False
    options.num_filters, options.num_cepstra, options.low_hz, options.high_hz = 40, 19, 100, 7600
    changes = {"use_energy": False, "num_bins": 40, "num_ceps": 20, "low_freq": 100, "high_freq": 7600}
    assert_equal(CepstraComputer(options).compute(x), kaldi(x, 16000, **changes))
    options.remove_dc = False
    options.window = "hamming"
    changes |= {"remove_dc_offset": False, "window_type": "hamming"}
    assert_equal(CepstraComputer(options).compute(x), kaldi(x, 16000, **changes))


def htk(x: np.ndarray, rate_hz: int) -> np.ndarray:
    """MFCC_0 by the HTK book, sections 5.2, 5.4 and 5.6: 25 ms every 10 ms, 26 channels, 12 cepstra, lifter 22."""
    length, shift, num_channels, num_cepstra = rate_hz // 40, rate_hz // 100, 26, 12
    size = 1 << (length - 1).bit_length()
    samples = 32768.0 * x.astype("f8")
    frames = np.stack([samples[t : t + length] for t in range(0, len(x) - length + 1, shift)])
    frames = np.hstack([0.03 * frames[:, :1], frames[:, 1:] - 0.97 * frames[:, :-1]])
    frames *= 0.54 - 0.46 * np.cos(2 * np.pi * np.arange(length) / (length - 1))
    magnitude = np.abs(np.fft.rfft(frames, size))
    mel = 1127 * np.log(1 + np.arange(size // 2 + 1) * rate_hz / size / 700)
    centres = np.linspace(0, 1127 * np.log(1 + rate_hz / 2 / 700), num_channels + 2)
    rising = (mel - centres[:-2, None]) / np.diff(centres)[:-1, None]
    falling = (centres[2:, None] - mel) / np.diff(centres)[1:, None]
    bank = np.clip(np.minimum(rising, falling), 0, None)
    logs = np.log(np.maximum(magnitude @ bank.T, 1.0))
    n, j = np.arange(num_cepstra + 1)[:, None], np.arange(1, num_channels + 1)
    cepstra = np.sqrt(2 / num_channels) * logs @ np.cos(np.pi * n / num_channels * (j - 0.5)).T
    cepstra[:, 1:] *= 1 + 22 / 2 * np.sin(np.pi * np.arange(1, num_cepstra + 1) / 22)
    return np.hstack([cepstra[:, 1:], cepstra[:, :1]])


@pytest.mark.parametrize("rate_hz", [8000, 16000])
def test_htk(rate_hz: int) -> None:
    x = voice(rate_hz)
    assert_equal(CepstraComputer(CepstraOptions.htk(rate_hz)).compute(x), htk(x, rate_hz))


def test_htk_with_log_energy() -> None:
    x = voice(16000)
    options = CepstraOptions.htk()
    options.use_energy = True
    ours = CepstraComputer(options).compute(x)
    frames = np.stack([32768.0 * x[t : t + 400].astype("f8") for t in range(0, len(x) - 399, 160)])
    assert_equal(ours[:, :12], htk(x, 16000)[:, :12])
    assert_equal(ours[:, 12:], np.log((frames**2).sum(axis=1))[:, None])
