# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""From a folder of labelled recordings to a trained recogniser: what ``hri train`` does, and `hri.train` in Python."""

from hri.training.choices import NETWORK_MIN_PERSONS, Choice, choose_options, has_embedding
from hri.training.copies import SNRS_DB, across_a_room, in_noise
from hri.training.train import Progress, fillers_of, train

__all__ = [
    "NETWORK_MIN_PERSONS",
    "SNRS_DB",
    "Choice",
    "Progress",
    "across_a_room",
    "choose_options",
    "fillers_of",
    "has_embedding",
    "in_noise",
    "train",
]
