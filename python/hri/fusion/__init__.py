# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Fusion of speech and gesture; knows decisions only."""

from hri.fusion.fuse import fuse
from hri.fusion.options import ASK, RULES, FusedDecision, FusionOptions

__all__ = ["ASK", "RULES", "FusedDecision", "FusionOptions", "fuse"]
