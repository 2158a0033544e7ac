# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Small models and recordings of one column, for tests of HTK's tools."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from conftest import CommandResult
from hri.htk import ParameterFile

STEPS = "0 0.7 0.3 0\n0 0.6 0.4 0\n0 0.3 0.4 0.3\n0 0 0 0\n"
"""Both states may begin, and the second leads back to the first."""


def succeed(result: CommandResult) -> str:
    assert result.code == 0, result.err
    return result.out


def model_text(name: str, means: tuple[float, ...] = (0.0, 8.0), steps: str = STEPS) -> str:
    states = "".join(
        f"<STATE> {number}\n<NUMMIXES> 2\n"
        + "".join(f"<MIXTURE> {m} 0.5\n<MEAN> 1\n{mean + m}\n<VARIANCE> 1\n1\n" for m in (1, 2))
        for number, mean in enumerate(means, 2)
    )
    size = len(means) + 2
    return f'~h "{name}"\n<BEGINHMM>\n<NUMSTATES> {size}\n{states}<TRANSP> {size}\n{steps}<ENDHMM>\n'


def clip(seed: int, *means: float) -> NDArray[np.float32]:
    rng = np.random.default_rng(seed)
    return (np.repeat(means or (0, 8, 0, 8), 5)[:, np.newaxis] + rng.normal(size=(5 * len(means or "0808"), 1))).astype(
        np.float32
    )


FILES = [f"u{number}.usr" for number in range(4)]


def make_work(folder: Path) -> None:
    """Four recordings of one column, an ergodic prototype, and floors."""
    for number, name in enumerate(FILES):
        ParameterFile(clip(number), "USER", 100000).write(folder / name)
    (folder / "header").write_text('~o <VECSIZE> 1 <USER>\n~v "varFloor1"\n<VARIANCE> 1\n3.0\n')
    (folder / "proto").write_text("~o <VECSIZE> 1 <USER>\n" + model_text("proto"))


def make_words(folder: Path) -> None:
    """Two words of two models, one with a short pause that may be skipped, and a network."""
    one = "0 1 0\n0 .5 .5\n0 0 0\n"
    pause = "0 .5 .5\n0 .5 .5\n0 0 0\n"
    parts = model_text("x-lo+y", (0,), one) + model_text("hi", (8,), one) + model_text("sp", (20,), pause)
    (folder / "models").write_text("~o <VECSIZE> 1 <USER>\n" + parts)
    (folder / "list").write_text("x-lo+y\nhi\nsp\nlow x-lo+y\n")
    (folder / "dict").write_text("up [UP] 0.5 low hi sp\ndown hi low sp\nedge [] hi\nunused nothing\n")
    (folder / "gram").write_text("( < up | down > )\n")
    (folder / "net").write_text(
        "N=4 L=5\nI=0\nI=1 W=up\nI=2 W=down\nI=3\nJ=0 S=0 E=1\nJ=1 S=0 E=2\nJ=2 S=1 E=2\nJ=3 S=1 E=3\nJ=4 S=2 E=3\n"
    )
    ParameterFile(clip(9, 0, 8, 20, 8, 0), "USER", 100000).write(folder / "v.usr")
