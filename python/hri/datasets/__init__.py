# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Labelled recordings in folders: where each one is, what it shows and who made it."""

from hri.datasets.dataset import Dataset, Sample, load_skig
from hri.datasets.folds import Fold
from hri.datasets.pattern import Pattern

__all__ = ["Dataset", "Fold", "Pattern", "Sample", "load_skig"]
