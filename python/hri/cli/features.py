# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri features``."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import click
import numpy as np

from hri._native import CepstraComputer
from hri.cli.output import OutputFile, write_text
from hri.cli.recognizers import parse_options
from hri.errors import InvalidArgument
from hri.features import KINDS, PRESETS, cepstra_options, column_names
from hri.media import Audio, read_audio
from hri.optional import import_optional


@click.command()
@click.argument("recording", type=click.Path(exists=True, dir_okay=False))
@click.option("--kind", type=click.Choice(list(KINDS)), default="mfcc", show_default=True)
@click.option(
    "--preset",
    type=click.Choice(list(PRESETS)),
    default="hri",
    show_default=True,
    help="Whose settings; with those of htk, kaldi and librosa, mfcc are the numbers of that program.",
)
@click.option(
    "--option",
    "options",
    multiple=True,
    metavar="NAME=VALUE",
    help="A field of CepstraOptions, such as num_cepstra=19; may be given several times.",
)
@click.option(
    "-o",
    "--out",
    type=OutputFile((".csv", ".npy")),
    metavar="FILE",
    help="Where to write them, .csv or .npy; without it, tab-separated to standard output.",
)
@click.option(
    "--plot", type=OutputFile((".png", ".svg", ".pdf")), metavar="FILE", help="Also draw waveform and features."
)
def features(
    recording: str, kind: Any, preset: Any, options: tuple[str, ...], out: str | None, plot: str | None
) -> None:
    """Cepstra of RECORDING, one row a frame.

    \b
    Examples:
      hri features seven.wav --kind hfcc -o seven.csv
      hri features seven.wav --preset kaldi --plot seven.png -o seven.npy
      hri features seven.wav --kind lpcc --option lpc_order=16 --option normalisation=none
    """
    audio = read_audio(recording)
    for note in audio.notes:
        click.echo(f"{recording}: {note}", err=True)
    try:
        chosen = cepstra_options(audio.sample_rate_hz, kind, preset, **parse_options(options))
    except (TypeError, ValueError) as error:  # an unknown name, or a value of another type
        raise InvalidArgument(f"--option: {error}") from error
    found = np.asarray(CepstraComputer(chosen).compute(audio.samples))
    names = column_names(chosen)
    if plot is not None:
        _plot(plot, audio, found, chosen.frame_shift_ms, f"{Path(recording).name}: {kind}, {preset}")
    if out is not None and Path(out).suffix.lower() == ".npy":
        Path(out).parent.mkdir(parents=True, exist_ok=True)
        np.save(out, found)
    else:
        text = _table(found, names, "," if out else "\t")
        click.echo(text, nl=False) if out is None else write_text(Path(out), text)
    if out is not None:
        click.echo(f"{out}: {found.shape[0]} frames of {found.shape[1]} features", err=True)


def _table(found: Any, names: list[str], separator: str) -> str:
    text = io.StringIO()
    np.savetxt(text, found, fmt="%.9g", delimiter=separator, header=separator.join(names), comments="")
    return text.getvalue()


def _plot(path: str, audio: Audio, found: Any, frame_shift_ms: float, title: str) -> None:
    import_optional("matplotlib", "plots", "to draw features")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 5.0), layout="constrained")
    FigureCanvasAgg(figure)
    wave, image = figure.subplots(2, 1, sharex=True, height_ratios=(1, 2))
    wave.plot(np.arange(len(audio.samples)) / audio.sample_rate_hz, audio.samples, linewidth=0.5)
    wave.set_title(title)
    seconds = len(found) * frame_shift_ms / 1000
    spread = found.std(axis=0)
    scaled = (found - found.mean(axis=0)) / np.where(spread > 0, spread, 1)
    image.imshow(scaled.T, aspect="auto", origin="lower", extent=(0, seconds, -0.5, found.shape[1] - 0.5), cmap="magma")
    image.set(xlabel="s", ylabel="feature (each scaled)")
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110)
