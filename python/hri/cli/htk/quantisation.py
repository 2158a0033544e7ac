# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk quant``: a VQ table of the frames of recordings."""

from __future__ import annotations

from pathlib import Path

import click
import numpy as np

from hri.cli.htk.data import check_headers, data_files
from hri.cli.htk.options import References, load_configuration, recording_options
from hri.cli.htk.standard import HtkCommand, NumbersOption, refused_options
from hri.cli.htk.training import NOTHING, label_option, segments
from hri.cli.output import OutputFile
from hri.core.display import count
from hri.core.errors import FormatError
from hri.core.files import make_folder
from hri.htk import ModelSet, VqTable, read_header
from hri.models import Codebook

MOST_CODEWORDS = 4096
_ONE_STREAM = "frames are one stream"
_LEAST_DEVIATION = 1e-6


def _size(ctx: click.Context, param: click.Parameter, value: str) -> int:
    """N of ``-n S N``, whose stream must be 1."""
    parts = value.split()
    if len(parts) != 2 or not all(part.isdecimal() and len(part) < 6 for part in parts):
        raise click.BadParameter("takes a stream, 1, and a number of codewords")
    stream, size = map(int, parts)
    if stream != 1 or not 1 <= size <= MOST_CODEWORDS:
        raise click.BadParameter(f"takes the stream 1, and 1 to {MOST_CODEWORDS} codewords")
    return size


@click.command(cls=HtkCommand)
@recording_options
@label_option
@click.option("-d", "by_variance", is_flag=True, help="Distances in units of the variance of every column.")
@click.option(
    "-n",
    "num_codewords",
    cls=NumbersOption,
    most=2,
    default="1 256",
    show_default=True,
    callback=_size,
    metavar="1 N",
    help="Codewords; fewer come out where the frames have fewer different values.",
)
@refused_options(
    f=("there are no full covariances", 0),
    g=("the covariance of all frames is not written", 0),
    s=(_ONE_STREAM, 1),
    t=("tables are lists, not trees", 0),
    w=(_ONE_STREAM, 2),
)
@click.argument("table", type=OutputFile())
@click.argument("files", nargs=-1)
def quant(
    configs: tuple[str, ...],
    scripts: tuple[str, ...],
    masters: tuple[str, ...],
    label_folder: str | None,
    suffix: str,
    trace: int,
    label: str | None,
    by_variance: bool,
    num_codewords: int,
    table: str,
    files: tuple[str, ...],
) -> None:
    """Make a VQ table, for discrete models, of the frames of recordings, as HQuant; the algorithm is that of LBG.

    VQTABLE of a configuration names the table to `copy`, `init`, `rest`, `erest` and `vite`, and _V in TARGETKIND says
    that frames become codewords; with SAVEASVQ = T `copy` writes these.

    \b
    Example:
      hri htk quant -C config -n 1 64 -S train.scp codebook
    """
    configuration = load_configuration(configs)
    recordings = data_files(files, scripts, NOTHING)
    if configuration.target.startswith("ANON"):
        kind = read_header(recordings[0].path).kind
        configuration.parse(f"TARGETKIND = {_plain(kind)}", recordings[0].path)
    models = ModelSet(configuration.target)
    period = check_headers(recordings, models, configuration)
    references = References(masters, label_folder, suffix)
    parts = [frames for _, frames in segments(recordings, models, configuration, references, label, period)]
    if not parts:
        raise FormatError(f"no recording has a label {label!r}; there is no frame to make a table of")
    rows = np.concatenate(parts)
    deviation = None
    if by_variance:
        deviation = np.maximum(rows.std(axis=0, dtype=np.float64), _LEAST_DEVIATION).astype(np.float32)
        rows = rows / deviation
    codebook = Codebook(num_codewords=num_codewords).fit(rows)
    codewords = codebook.cluster_centers_
    make_folder(Path(table).parent)
    VqTable(codewords, models.kind, deviation).write(table)
    if trace:
        distortion = codebook.report_.distortions[-1]
        click.echo(
            f"{count(len(rows), 'frame')} -> {count(len(codewords), 'codeword')}, distortion {distortion:.4f}: {table}"
        )


def _plain(kind: str) -> str:
    """The kind without _C and _K, which say how files hold frames."""
    base, *letters = kind.split("_")
    return "_".join([base, *(letter for letter in letters if letter not in "CK")])
