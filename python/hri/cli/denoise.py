# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri denoise``."""

from __future__ import annotations

import click
import numpy as np

from hri.cli.groups import CheckedCommand, FiniteRange, refuse_given
from hri.cli.output import OutputFile
from hri.core.errors import InvalidArgument
from hri.io import write_wav_pcm16
from hri.media import read_audio
from hri.signal.noise_reduction import NOISES, RULES, SHAPES, approximation
from hri.signal.noise_reduction import denoise as denoised


@click.command(cls=CheckedCommand)
@click.argument("source", metavar="IN", type=click.Path(exists=True, dir_okay=False))
@click.argument("target", metavar="OUT.wav", type=OutputFile((".wav",)))
@click.option("--wavelet", default="sym8", show_default=True, help="One of PyWavelets' names.")
@click.option("--threshold", type=click.Choice(list(RULES)), default="bayes", show_default=True)
@click.option("--shape", type=click.Choice(list(SHAPES)), default="soft", show_default=True)
@click.option(
    "--noise",
    type=click.Choice(list(NOISES)),
    default="quietest",
    show_default=True,
    help="Where noise is measured: the quietest tenth, each level's median, or the finest level's.",
)
@click.option("--levels", type=click.IntRange(0, 62), default=0, show_default=True, help="0: as many as are usual.")
@click.option("--strength", type=FiniteRange(0.0), default=1.0, show_default=True, help="Factor of thresholds.")
@click.option(
    "--approximation",
    "level",
    type=click.IntRange(1, 16),
    help="Instead keep the approximation of this level, at 1 / 2^level of the rate.",
)
def denoise(
    source: str,
    target: str,
    wavelet: str,
    threshold: str,
    shape: str,
    noise: str,
    levels: int,
    strength: float,
    level: int | None,
) -> None:
    """Reduce stationary noise in the recording IN by wavelet shrinkage.

    \b
    Examples:
      hri denoise noisy.wav clean.wav
      hri denoise noisy.wav clean.wav --wavelet db6 --threshold sure --shape hard
      hri denoise noisy.wav low.wav --approximation 1
    """
    if level is not None:
        shrinkage = ("threshold", "shape", "noise", "levels", "strength")
        refuse_given(shrinkage, "is of shrinkage, which --approximation does without")
    audio = read_audio(source)
    rate_hz = audio.sample_rate_hz
    if level is None:
        samples = denoised(
            audio.samples,
            wavelet,
            level=levels or None,
            threshold=threshold,
            shape=shape,
            noise=noise,
            strength=strength,
        )
    else:
        if rate_hz % 2**level:
            raise InvalidArgument(f"--approximation {level}: {rate_hz} Hz cannot be divided by {2**level}")
        rate_hz //= 2**level
        samples = approximation(audio.samples, wavelet, "periodization", level)
    write_wav_pcm16(target, np.clip(samples, -1.0, 1.0), rate_hz)
    click.echo(f"{target}\t{len(samples) / rate_hz:.2f} s at {rate_hz} Hz")
