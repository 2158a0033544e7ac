# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Plots of the demo, as PNG bytes."""

from __future__ import annotations

import io
from typing import Any

import numpy as np

from hri.core.plotting import new_figure
from hri.demo.scenes import Scene
from hri.evaluation import EvaluationResult
from hri.features import CepstraComputer, CepstraOptions
from hri.signal import find_speech

_BLUE = "#3b6fb6"


def plot_scene(scene: Scene) -> bytes:
    """What was heard (waveform and cepstra), and what was seen (picture and silhouette)."""
    from hri.vision import SilhouetteExtractor, SilhouetteOptions

    figure = new_figure((10.5, 4.6))
    grid = figure.add_gridspec(2, 2, width_ratios=(1.6, 1.0))
    samples, rate_hz = scene.audio.samples, scene.audio.sample_rate_hz
    wave = figure.add_subplot(grid[0, 0])
    wave.plot(np.arange(len(samples)) / rate_hz, samples, color=_BLUE, linewidth=0.5)
    bounds = find_speech(samples, rate_hz)
    if bounds is not None:
        wave.axvspan(bounds[0] / rate_hz, bounds[1] / rate_hz, color=_BLUE, alpha=0.12, linewidth=0)
    wave.set(title="heard: waveform and end points", xlabel="s", ylim=(-1, 1), xlim=(0, len(samples) / rate_hz))

    cepstra = CepstraComputer(CepstraOptions(sample_rate_hz=rate_hz, delta_orders=0)).compute(samples)
    image = figure.add_subplot(grid[1, 0])
    image.imshow(np.asarray(cepstra).T, aspect="auto", origin="lower", cmap="magma", interpolation="nearest")
    image.set(title="mel cepstra", xlabel="frame (10 ms)", ylabel="coefficient")

    frame = scene.frames[len(scene.frames) // 2]
    silhouette = SilhouetteExtractor(SilhouetteOptions()).extract(frame)
    for row, (title, picture, cmap) in enumerate(
        (("seen: held frame", frame[:, :, ::-1], None), ("silhouette of the hand", silhouette.mask, "gray"))
    ):
        axes = figure.add_subplot(grid[row, 1])
        axes.imshow(picture, cmap=cmap)
        axes.set_title(title)
        axes.set_axis_off()
    return _png(figure)


def plot_confusions(words: EvaluationResult, signs: EvaluationResult) -> bytes:
    """Confusion matrices of both modes side by side."""
    figure = new_figure((9.5, 4.6))
    for place, (title, result) in enumerate((("spoken words", words), ("signs", signs))):
        axes = figure.add_subplot(1, 2, place + 1)
        counts = result.confusion()
        columns = [*result.labels, "none"]
        axes.imshow(counts / np.maximum(counts.sum(axis=1, keepdims=True), 1), cmap="Blues", vmin=0, vmax=1)
        for (row, column), count in np.ndenumerate(counts):
            if count:
                axes.text(column, row, str(count), ha="center", va="center", color="white", fontsize=8)
        axes.set_xticks(range(len(columns)), columns, rotation=60, ha="right", fontsize=8)
        axes.set_yticks(range(len(result.labels)), result.labels, fontsize=8)
        axes.set(xlabel="recognised as", ylabel="truth")
        axes.set_title(f"{title}, unseen synthetic people: {100 * result.mean:.0f} %")
    return _png(figure)


def _png(figure: Any) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=110)
    return buffer.getvalue()
