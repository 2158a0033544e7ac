# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Honest accuracy: people are never shared between training and test."""

from hri.evaluation.conditions import expose, make_noise, mix_noise
from hri.evaluation.evaluate import cross_validate, evaluate_split
from hri.evaluation.result import EvaluationResult, FoldResult, Trial

__all__ = [
    "EvaluationResult",
    "FoldResult",
    "Trial",
    "cross_validate",
    "evaluate_split",
    "expose",
    "make_noise",
    "mix_noise",
]
