# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk``: HTK's tools, with their options."""

from __future__ import annotations

import click

from hri.cli.groups import SuggestingGroup
from hri.cli.htk.editing import hed
from hri.cli.htk.embedded import erest
from hri.cli.htk.flat_start import compv
from hri.cli.htk.networks import build, parse, sgen
from hri.cli.htk.parameters import copy, list_files
from hri.cli.htk.quantisation import quant
from hri.cli.htk.recognition import vite
from hri.cli.htk.scoring import results
from hri.cli.htk.training import init, rest


@click.group(cls=SuggestingGroup)
def htk() -> None:
    """HTK's tools on HTK's files, with HTK's options.

    \b
    Examples:
      hri htk copy -C config -S copy.scp
      hri htk list -h -e 9 a.mfc
      hri htk quant -C config -n 1 64 -S train.scp codebook
      hri htk compv -m -M hmm0 -S train.scp proto
      hri htk erest -H hmm0/models -M hmm1 -I words.mlf -S train.scp list
      hri htk parse grammar wdnet
      hri htk vite -H models -w wdnet -S test.scp -i found.mlf dict list
      hri htk results -I words.mlf list found.mlf
    """


for _command in (copy, list_files, quant, results, parse, build, sgen, vite, compv, init, rest, erest, hed):
    htk.add_command(_command)
