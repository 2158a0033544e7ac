# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Linear prediction, streams, RASTA, running normalisation, warping and envelopes against SciPy and NumPy."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from scipy.linalg import solve_toeplitz
from scipy.signal import lfilter

from hri._native import CepstraComputer, CepstraOptions, CepstraStream
from hri.core.errors import InvalidArgument
from hri.features import FilterBankOptions, filter_bank, filter_edges, lpc_cepstrum, spectral_envelope
from hri.signal import linear_prediction


def audio(count: int = 8000, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return (lfilter([1], [1, -1.2, 0.8], rng.normal(size=count)) * np.linspace(0.01, 0.1, count)).astype("f4")


def plain(**fields: object) -> CepstraOptions:
    return CepstraOptions(**({"normalisation": "none", "delta_orders": 0} | fields))


def windowed(x: np.ndarray) -> np.ndarray:
    """Frames of 400 every 160, pre-emphasised, under Hamming's window, float64."""
    x = x.astype("f8")
    emphasised = x - 0.97 * np.concatenate([x[:1], x[:-1]])
    return np.stack([emphasised[t : t + 400] for t in range(0, len(x) - 399, 160)]) * np.hamming(400)


def test_prediction_solves_the_normal_equations() -> None:
    frame = windowed(audio())[20]
    for order in (1, 2, 3, 12, 40):
        a, gain = linear_prediction(frame, order)
        r = np.correlate(frame, frame, "full")[399 : 399 + order + 1]
        np.testing.assert_allclose(a, solve_toeplitz(r[:-1], -r[1:]), rtol=1e-7, atol=1e-9)
        assert gain == pytest.approx(r[0] + a @ r[1:], rel=1e-9)


def test_cepstrum_is_that_of_the_all_pole_spectrum() -> None:
    a, gain = linear_prediction(windowed(audio())[20], 12)
    log_spectrum = np.log(gain / np.abs(np.fft.fft(np.r_[1, a], 1 << 15)) ** 2)
    expected = np.fft.ifft(log_spectrum).real
    np.testing.assert_allclose(lpc_cepstrum(a, gain, 30), expected[:31], atol=1e-9)


def test_silence_is_predicted_by_zeros() -> None:
    a, gain = linear_prediction(np.zeros(50), 4)
    np.testing.assert_array_equal(a, 0)
    assert gain == 0
    with pytest.raises(InvalidArgument, match="gain"):
        lpc_cepstrum(a, gain, 4)


@pytest.mark.parametrize("use_c0", [True, False])
def test_lpcc_of_a_clip(use_c0: bool) -> None:
    options = plain(kind="linear_prediction", lpc_order=14, num_cepstra=16, use_c0=use_c0)
    ours = CepstraComputer(options).compute(audio())
    lifter = 1 + 11 * np.sin(np.pi * np.arange(17) / 22)
    theirs = np.stack([lpc_cepstrum(*linear_prediction(f, 14), 16) for f in windowed(audio())])
    np.testing.assert_allclose(ours, (theirs * lifter)[:, 0 if use_c0 else 1 :], rtol=1e-4, atol=2e-4)
    assert np.isfinite(CepstraComputer(options).compute(np.zeros(4000))).all()


def test_log_energy_stands_in_the_place_of_c0() -> None:
    x = audio()
    for kind in ("filter_bank", "linear_prediction"):
        with_c0 = CepstraComputer(plain(kind=kind)).compute(x)
        with_energy = CepstraComputer(plain(kind=kind, use_energy=True)).compute(x)
        np.testing.assert_array_equal(with_energy[:, 1:], with_c0[:, 1:])
        energies = [np.square(x[t : t + 400].astype("f8")).sum() for t in range(0, len(x) - 399, 160)]
        np.testing.assert_allclose(with_energy[:, 0], np.log(energies), rtol=1e-5)


@pytest.mark.parametrize("pole", [0.94, 0.98])
def test_rasta_is_the_filter_of_the_paper(pole: float) -> None:
    static = CepstraComputer(plain()).compute(audio())
    ours = CepstraComputer(plain(rasta_pole=pole)).compute(audio())
    held = np.vstack([np.repeat(static[:1], 4, axis=0), static]).astype("f8")  # the first frame stood for ever
    change = lfilter([0.2, 0.1, 0, -0.1, -0.2], [1], held, axis=0)[4:]
    np.testing.assert_allclose(ours, lfilter([1], [1, -pole], change, axis=0), atol=1e-4)


def test_rasta_takes_a_channel_away() -> None:
    x = audio(16000)
    channel = lfilter([1, 0.6], [1], x).astype("f4")
    far, near = (
        np.abs(CepstraComputer(options).compute(x) - CepstraComputer(options).compute(channel))[50:].mean()
        for options in (plain(), plain(rasta_pole=0.94))
    )
    assert near < 0.3 * far


@pytest.mark.parametrize("kind", ["running_mean", "running_mean_variance"])
def test_running_normalisation(kind: str) -> None:
    static = CepstraComputer(plain()).compute(audio(32000)).astype("f8")
    ours = CepstraComputer(plain(normalisation=kind, running_s=0.5)).compute(audio(32000))
    for t in (0, 1, 30, 49):  # all frames so far, while they are fewer than 50
        expected = static[t] - static[: t + 1].mean(axis=0)
        if kind == "running_mean_variance" and t > 0:
            expected /= static[: t + 1].std(axis=0)
        np.testing.assert_allclose(ours[t], expected, atol=2e-4)
    # From then on both forget, by 1/50 a frame.
    mean, variance = static[:50].mean(axis=0), static[:50].var(axis=0)
    for frame in static[50:]:
        variance = (1 - 1 / 50) * (variance + (frame - mean) ** 2 / 50)
        mean += (frame - mean) / 50
    deviation = np.sqrt(variance) if kind == "running_mean_variance" else 1
    np.testing.assert_allclose(ours[-1], (static[-1] - mean) / deviation, atol=2e-4)


STREAMS = {
    "defaults": CepstraOptions(normalisation="none"),
    "statics": plain(),
    "running": CepstraOptions(normalisation="running_mean_variance", rasta_pole=0.94),
    "centred": CepstraOptions(normalisation="none", padding="centred", delta_orders=1, delta_window=3),
    "lpcc": CepstraOptions(kind="linear_prediction", normalisation="running_mean"),
    "kaldi": CepstraOptions.kaldi(),
    "gaps": plain(frame_length_ms=5, frame_shift_ms=20, delta_orders=2),
}


@pytest.mark.parametrize("name", STREAMS)
@pytest.mark.parametrize("block", [1, 7, 160, 1000, 20000])
def test_a_stream_gives_the_bits_of_the_whole(name: str, block: int) -> None:
    options, x = STREAMS[name], audio(20011 if block > 1 else 1500)
    stream = CepstraStream(options)
    for _ in range(2):
        parts = [stream.push(part) for part in np.split(x, range(block, len(x), block))]
        found = np.vstack([*parts, stream.finish()])
        np.testing.assert_array_equal(found, CepstraComputer(options).compute(x))


def test_a_stream_is_late_by_its_deltas_only() -> None:
    stream = CepstraStream(CepstraOptions(normalisation="none"))
    counts = list(itertools.accumulate(len(stream.push(part)) for part in np.split(audio(8000), 50)))
    assert counts[-1] == 48 - 4 and len(stream.finish()) == 4
    assert len(stream.finish()) == 0


def test_a_stream_keeps_the_channel_where_asked() -> None:
    options = plain(normalisation="running_mean")
    stream, x = CepstraStream(options), audio()
    first = np.vstack([stream.push(x), stream.finish(keep_normalisation=True)])
    second = np.vstack([stream.push(x), stream.finish()])
    np.testing.assert_array_equal(first[0], 0)
    assert np.abs(second[0]).max() > 0.1
    np.testing.assert_array_equal(stream.push(x), first)


@pytest.mark.parametrize(
    ("fields", "message"),
    [({"normalisation": "mean"}, "normalisation"), ({"normalisation": "none", "top_db": 80.0}, "top_db")],
)
def test_a_stream_refuses_what_needs_the_whole(fields: dict, message: str) -> None:
    with pytest.raises(InvalidArgument, match=message):
        CepstraStream(CepstraOptions(**fields))


def test_a_stream_refuses_what_is_not_finite_and_goes_on() -> None:
    stream, x = CepstraStream(plain()), audio()
    with pytest.raises(InvalidArgument, match="sample 2"):
        stream.push(np.array([0, 0, np.nan]))
    np.testing.assert_array_equal(stream.push(x), CepstraComputer(plain()).compute(x))


@pytest.mark.parametrize("warp", [0.85, 1.0, 1.2])
def test_piecewise_warp_is_kaldis(warp: float) -> None:
    low, high, bend_low, bend_high = 50.0, 7800.0, 200.0, 7000.0
    fields = {"num_filters": 20, "low_hz": low, "high_hz": high}
    plain_edges = filter_edges(FilterBankOptions(**fields), 16000)
    options = FilterBankOptions(warp=warp, warp_low_hz=bend_low, warp_high_hz=bend_high, **fields)
    # Kaldi's VtlnWarpFreq, whose factor is 1 / warp.
    left, right = bend_low * max(1, 1 / warp), bend_high * min(1, 1 / warp)
    expected = np.interp(plain_edges, [low, left, right, high], [low, warp * left, warp * right, high])
    np.testing.assert_allclose(filter_edges(options, 16000), expected, rtol=1e-9)


def test_envelope_is_that_of_the_thesis() -> None:
    cepstra = np.random.default_rng(0).normal(size=(5, 12)).astype("f4")
    w = np.pi * np.arange(1, 11) / 10
    expected = np.exp(cepstra.astype("f8") @ np.cos(np.arange(1, 13)[:, None] * w))
    np.testing.assert_allclose(spectral_envelope(cepstra, 10), expected, rtol=1e-5)


@pytest.mark.parametrize(
    "fields",
    [
        {"fft_size": 256},
        {"fft_size": 513},
        {"sample_scale": 0.0},
        {"energy_floor": 0.0},
        {"top_db": -1.0},
        {"rasta_pole": 1.0},
        {"running_s": 0.0},
        {"use_energy": True, "use_c0": False},
        {"lpc_order": 65, "kind": "linear_prediction"},
        {"num_cepstra": 65, "kind": "linear_prediction"},
        {"warp_low_hz": 200.0},
        {"warp_high_hz": 9000.0, "warp_low_hz": 200.0},
    ],
)
def test_impossible_options_are_named(fields: dict) -> None:
    with pytest.raises(InvalidArgument, match=next(iter(fields))):
        CepstraComputer(CepstraOptions(**fields))


def test_any_fft_size_will_do() -> None:
    x = audio()
    for size in (400, 402, 500, 512, 1024):
        ours = CepstraComputer(plain(fft_size=size, lifter=0.0)).compute(x)
        bank = filter_bank(FilterBankOptions(), 16000, size).astype("f8")
        logs = np.log(np.abs(np.fft.rfft(windowed(x), size)) ** 2 @ bank.T)
        np.testing.assert_allclose(ours[:, 0], logs.sum(axis=1) / np.sqrt(26), rtol=1e-5)


def test_every_option_tells_what_it_is() -> None:
    for name in CepstraOptions().as_dict():
        assert getattr(CepstraOptions, name).__doc__, name
