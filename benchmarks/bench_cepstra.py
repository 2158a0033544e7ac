# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Cepstra against librosa and kaldi-native-fbank: 10 s at 16 kHz, frames of 25 ms every 10 ms, FFT of 512."""

from __future__ import annotations

import numpy as np

from hri.features import CepstraComputer, CepstraOptions, FilterBankOptions, filter_bank
from timing import Bench, Details, Timed, medians

RATE_HZ = 16000


def _audio(seconds: float = 10.0, seed: int = 0) -> np.ndarray:
    """Noise whose level changes, float32."""
    rng = np.random.default_rng(seed)
    count = int(seconds * RATE_HZ)
    swell = 0.05 + 0.2 * np.abs(np.sin(2 * np.pi * 3 * np.arange(count) / RATE_HZ))
    return (swell * rng.standard_normal(count)).astype(np.float32)


def _computer(kind: str = "mel", delta_orders: int = 0) -> CepstraComputer:
    return CepstraComputer(
        CepstraOptions(
            sample_rate_hz=RATE_HZ,
            filter_bank=kind,
            pre_emphasis=0.0,
            low_hz=0.0,
            normalisation="none",
            lifter=0.0,
            delta_orders=delta_orders,
        )
    )


def _librosas(audio: np.ndarray, kind: str = "mel") -> np.ndarray:
    """13 cepstra by librosa, shape (13, num_frames); it has no HFCC bank, and gets ours."""
    import librosa

    settings = {"n_fft": 512, "win_length": 400, "hop_length": 160, "window": np.hamming(400), "center": False}
    # librosa puts the window in the middle of the FFT's 512 samples, we at their start.
    padded = np.pad(audio, 56)
    if kind == "mel":
        power = librosa.feature.melspectrogram(y=padded, sr=RATE_HZ, n_mels=26, htk=True, norm=None, **settings)
    else:
        power = _hfcc_bank() @ np.abs(librosa.stft(padded, **settings)) ** 2
    return librosa.feature.mfcc(S=np.log(np.maximum(power, 1e-10)), n_mfcc=13)


def _hfcc_bank() -> np.ndarray:
    return filter_bank(FilterBankOptions(kind="hfcc", low_hz=0.0), RATE_HZ, 512)


def _against_librosa(kind: str) -> tuple[float, float, int]:
    audio, computer = _audio(), _computer(kind)
    ours, theirs = computer.compute(audio), _librosas(audio, kind).T
    count = min(len(ours), len(theirs))
    assert np.allclose(ours[:count], theirs[:count], atol=2e-3)
    seconds = medians(lambda: computer.compute(audio), lambda: _librosas(audio, kind), 31)
    return *seconds, len(ours)


def mfcc() -> Timed:
    """13 mel cepstra of 10 s at 16 kHz (26 filters, 25 ms every 10 ms, FFT of 512)."""
    ours, peer, count = _against_librosa("mel")
    return ours, peer, {"us_a_frame": 1e6 * ours / count, "librosa_us_a_frame": 1e6 * peer / count}


def mfcc_kaldi() -> Timed:
    """13 mel cepstra of 10 s at 16 kHz as Kaldi makes them, of 26 filters."""
    import kaldi_native_fbank as knf

    audio = _audio()
    options = CepstraOptions.kaldi(RATE_HZ)
    options.num_filters = 26
    computer = CepstraComputer(options)
    settings = knf.MfccOptions()
    settings.frame_opts.dither = 0
    settings.mel_opts.num_bins = 26
    integers = (32768 * audio).tolist()  # it takes lists faster than arrays

    def peer() -> list[np.ndarray]:
        extractor = knf.OnlineMfcc(settings)
        extractor.accept_waveform(RATE_HZ, integers)
        extractor.input_finished()
        return [extractor.get_frame(i) for i in range(extractor.num_frames_ready)]

    ours = computer.compute(audio)
    assert np.allclose(ours, np.stack(peer()), rtol=1e-4, atol=1e-2)
    seconds = medians(lambda: computer.compute(audio), peer, 31)
    return *seconds, {"us_a_frame": 1e6 * seconds[0] / len(ours), "kaldi_us_a_frame": 1e6 * seconds[1] / len(ours)}


def hfcc() -> Timed:
    """The same with the filters of HFCC, whose bank librosa is given."""
    ours, peer, count = _against_librosa("hfcc")
    audio, hfcc_computer, mfcc_computer = _audio(), _computer("hfcc"), _computer("mel")
    both = medians(lambda: hfcc_computer.compute(audio), lambda: mfcc_computer.compute(audio), 101)
    details: Details = {
        "us_a_frame": 1e6 * ours / count,
        "librosa_us_a_frame": 1e6 * peer / count,
        "times_our_mfcc": both[0] / both[1],
    }
    return ours, peer, details


def mfcc_deltas() -> Timed:
    """13 mel cepstra of 10 s at 16 kHz, with two orders of deltas."""
    import librosa

    audio, computer = _audio(), _computer(delta_orders=2)

    def peer() -> np.ndarray:
        static = _librosas(audio)
        velocity = librosa.feature.delta(static, width=5, mode="nearest")
        return np.vstack([static, velocity, librosa.feature.delta(velocity, width=5, mode="nearest")])

    ours, theirs = computer.compute(audio), peer().T
    count = min(len(ours), len(theirs))
    inside = slice(4, count - 4)
    assert np.allclose(ours[inside], theirs[inside], atol=2e-3)
    return medians(lambda: computer.compute(audio), peer)


BENCHES = [
    Bench("mfcc", mfcc, "librosa"),
    Bench("hfcc", hfcc, "librosa"),
    Bench("mfcc_kaldi", mfcc_kaldi, "kaldi-native-fbank"),
    Bench("mfcc_deltas", mfcc_deltas, "librosa"),
]
