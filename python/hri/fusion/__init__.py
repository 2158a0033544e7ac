# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Fusion of speech and gesture; knows decisions only."""

from hri.fusion.fuse import fuse
from hri.fusion.options import RULES, FusedDecision, FusionOptions

__all__ = ["RULES", "FusedDecision", "FusionOptions", "fuse"]
