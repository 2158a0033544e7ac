# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri htk parse`` and ``hri htk sgen``."""

from __future__ import annotations

import click
import numpy as np

from hri.cli.groups import CheckedCommand
from hri.cli.htk.options import INPUT
from hri.cli.output import OutputFile
from hri.core.errors import FormatError
from hri.htk import Dictionary, WordLattice, random_sentence


@click.command(cls=CheckedCommand)
@click.argument("grammar", type=INPUT)
@click.argument("lattice", type=OutputFile())
def parse(grammar: str, lattice: str) -> None:
    """Compile a grammar to a word network, as HParse.

    \b
    Example:
      hri htk parse grammar wdnet
    """
    WordLattice.read_grammar(grammar).write(lattice)


@click.command(cls=CheckedCommand)
@click.option("-n", "count", type=click.IntRange(1), default=100, show_default=True, help="How many sentences.")
@click.option("-l", "numbered", is_flag=True, help="Number them.")
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of what is drawn.")
@click.argument("lattice", type=INPUT)
@click.argument("dictionary", type=INPUT)
def sgen(count: int, numbered: bool, seed: int, lattice: str, dictionary: str) -> None:
    """Print random sentences of a word network, as HSGen.

    \b
    Example:
      hri htk sgen -n 5 wdnet dict
    """
    network = WordLattice.read(lattice)
    known = {entry.word for entry in Dictionary.read(dictionary).entries}
    for word in network.words:
        if word not in known and word != "!NULL":
            raise FormatError(f"{dictionary}: does not have {word!r}, a word of {lattice}")
    rng = np.random.default_rng(seed)
    for number in range(1, count + 1):
        sentence = " ".join(random_sentence(network, rng))
        click.echo(f"{number}. {sentence}" if numbered else sentence)
