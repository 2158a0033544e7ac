# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri features``."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
import numpy as np

from hri.cli.faces import faces_option
from hri.cli.groups import CheckedCommand, refuse_given
from hri.cli.messages import note
from hri.cli.output import OutputFile, write_bytes, write_text
from hri.cli.recognizers import naming_options, parse_options
from hri.core.errors import InvalidArgument
from hri.core.plotting import new_figure, save_figure
from hri.features import KINDS, PRESETS, CepstraComputer, cepstra_options, column_names
from hri.features.hand import HAND_KINDS, hand_column_names, hand_features
from hri.media import IMAGE_SUFFIXES, VIDEO_SUFFIXES, Audio, frame_rate, naming_file, read_audio, read_frames
from hri.vision.hands import find_silhouettes


@click.command(cls=CheckedCommand)
@click.argument("recording", type=click.Path(exists=True, dir_okay=False))
@click.option(
    "--kind",
    type=click.Choice([*KINDS, *HAND_KINDS]),
    help=f"Of sound: {', '.join(KINDS)} (mfcc if not given); of a picture or video: {', '.join(HAND_KINDS)} (hand).",
)
@click.option(
    "--preset",
    type=click.Choice(list(PRESETS)),
    default="hri",
    show_default=True,
    help="Whose settings, of sound; with those of htk, kaldi and librosa, mfcc are the numbers of that program.",
)
@click.option(
    "--option",
    "options",
    multiple=True,
    metavar="NAME=VALUE",
    help="A field of the kind's options, such as num_cepstra=19 (CepstraOptions) or num_harmonics=8 "
    "(FourierDescriptorOptions); may be given several times.",
)
@faces_option("never: an open palm may look like a face")
@click.option(
    "-o",
    "--out",
    type=OutputFile((".csv", ".npy")),
    metavar="FILE",
    help="Where to write them, .csv or .npy; without it, tab-separated to standard output.",
)
@click.option(
    "--plot",
    type=OutputFile((".png", ".svg", ".pdf")),
    metavar="FILE",
    help="Also draw the waveform, or the hand with its outline, and the features.",
)
def features(
    recording: str,
    kind: str | None,
    preset: Any,
    options: tuple[str, ...],
    faces: str | None,
    out: str | None,
    plot: str | None,
) -> None:
    """Features of RECORDING, one row a frame: cepstra of sound, shapes of the hand in a picture or video.

    \b
    Examples:
      hri features seven.wav --kind hfcc -o seven.csv
      hri features seven.wav --preset kaldi --plot seven.png -o seven.npy
      hri features seven.wav --kind lpcc --option lpc_order=16 --option normalisation=none
      hri features seven.jpg --kind wavelet --plot seven.png
      hri features swipe.mp4 --kind track --option delta_orders=2 -o swipe.csv
    """
    seen = Path(recording).suffix.lower() in {*IMAGE_SUFFIXES, *VIDEO_SUFFIXES}
    known = list(HAND_KINDS if seen else KINDS)
    kind = kind or ("hand" if seen else "mfcc")
    if kind not in known:
        raise click.UsageError(f"{recording} has no features of kind {kind}; there are: {', '.join(known)}")
    if seen:
        refuse_given(("preset",), "is of sound")
    else:
        refuse_given(("faces",), "is of pictures and videos")
    found = _seen(recording, kind, options, faces) if seen else _heard(recording, kind, preset, options)
    if plot is not None:
        _plot(plot, found)
    if out is not None and Path(out).suffix.lower() == ".npy":
        stored = io.BytesIO()
        np.save(stored, found.rows)
        write_bytes(Path(out), stored.getvalue())
    else:
        text = _table(found.rows, found.names, "," if out else "\t")
        click.echo(text, nl=False) if out is None else write_text(Path(out), text)
    if out is not None:
        note(f"{out}: {found.rows.shape[0]} frames of {found.rows.shape[1]} features")


@dataclass(frozen=True)
class _Found:
    """Features, what they are called, and what is drawn beside them: the sound, or a picture with a mask."""

    title: str
    rows: Any
    names: list[str]
    frames_per_second: float
    audio: Audio | None = None
    picture: Any = None
    mask: Any = None


def _heard(recording: str, kind: Any, preset: Any, options: tuple[str, ...]) -> _Found:
    audio = read_audio(recording)
    for text in audio.notes:
        note(f"{recording}: {text}")
    with naming_options():
        chosen = cepstra_options(audio.sample_rate_hz, kind, preset, **parse_options(options))
    with naming_file(audio.path):
        rows = np.asarray(CepstraComputer(chosen).compute(audio.samples))
    title = f"{Path(recording).name}: {kind}, {preset}"
    return _Found(title, rows, column_names(chosen), 1000 / chosen.frame_shift_ms, audio)


def _seen(recording: str, kind: Any, options: tuple[str, ...], faces: str | None) -> _Found:
    frames = read_frames(recording).frames
    rate = frame_rate(recording) if Path(recording).suffix.lower() in VIDEO_SUFFIXES else 1.0
    fields = parse_options(options)
    if kind == "track":
        fields.setdefault("frames_per_second", rate)
    with naming_options():
        names = hand_column_names(kind, **fields)
    shapes = find_silhouettes(frames, faces=faces or "never")
    empty = [str(i) for i, shape in enumerate(shapes) if not shape.mask.any()]
    if len(empty) == len(shapes):
        raise InvalidArgument(f"{recording}: no hand is seen")
    if empty:
        note(f"{recording}: no hand, and so no row, in frames {', '.join(empty)}")
    rows = hand_features([s.grey for s in shapes], [s.mask for s in shapes], kind, **fields)
    middle = max((i for i in range(len(shapes)) if str(i) not in empty), key=lambda i: -abs(i - len(shapes) // 2))
    title = f"{Path(recording).name}: {kind}"
    return _Found(title, rows, names, rate, picture=frames[middle], mask=shapes[middle].mask)


def _table(found: Any, names: list[str], separator: str) -> str:
    text = io.StringIO()
    np.savetxt(text, found, fmt="%.9g", delimiter=separator, header=separator.join(names), comments="")
    return text.getvalue()


def _plot(path: str, found: _Found) -> None:
    figure = new_figure((9.0, 5.0), "to draw features")
    beside = found.audio is None
    above, below = figure.subplots(*((1, 2) if beside else (2, 1)), sharex=not beside)
    above.set_title(found.title)
    if found.audio is not None:
        samples = found.audio.samples
        above.plot(np.arange(len(samples)) / found.audio.sample_rate_hz, samples, linewidth=0.5)
    else:
        above.imshow(found.picture[:, :, ::-1])
        above.contour(found.mask > 0, levels=[0.5], colors="lime", linewidths=1.2)
        above.set_axis_off()
    rows = found.rows
    if len(rows) == 1:
        below.plot(rows[0], ".-", linewidth=0.8)
        below.set(xlabel="feature", ylabel="value")
    else:
        spread = rows.std(axis=0)
        scaled = (rows - rows.mean(axis=0)) / np.where(spread > 0, spread, 1)
        extent = (0, len(rows) / found.frames_per_second, -0.5, rows.shape[1] - 0.5)
        below.imshow(scaled.T, aspect="auto", origin="lower", extent=extent, cmap="magma")
        below.set(xlabel="s", ylabel="feature (each scaled)")
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    save_figure(figure, path)
