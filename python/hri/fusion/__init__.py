# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Fusion of speech and gesture; of recognition it knows decisions only."""

from hri.fusion.fuse import CombiningRule, fuse
from hri.fusion.learned import KINDS, LearnedFusion
from hri.fusion.options import ASK, RULES, FusedDecision, FusionOptions
from hri.fusion.pairs import DecisionPairs, pair_decisions

__all__ = [
    "ASK",
    "KINDS",
    "RULES",
    "CombiningRule",
    "DecisionPairs",
    "FusedDecision",
    "FusionOptions",
    "LearnedFusion",
    "fuse",
    "pair_decisions",
]
