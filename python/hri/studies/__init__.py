# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Measured claims on real recordings: ``hri study list``, ``hri study NAME --data DIR``."""

from hri.errors import InvalidArgument
from hri.studies import fusion, parity, signs, speech
from hri.studies.registry import Study, find_data, run_study

STUDIES: dict[str, Study] = {s.name: s for s in (*speech.STUDIES, *signs.STUDIES, *fusion.STUDIES, *parity.STUDIES)}


def get_study(name: str) -> Study:
    """The study of that name. Raises InvalidArgument that lists the names there are."""
    if name not in STUDIES:
        raise InvalidArgument(f"no study '{name}'; there are: {', '.join(STUDIES)}")
    return STUDIES[name]


__all__ = ["STUDIES", "Study", "find_data", "get_study", "run_study"]
