# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Accuracy with persons held out, in noise, rooms and other light."""

from hri.evaluation.calibration import Reliability, ReliabilityBin, reliability
from hri.evaluation.conditions import Condition, FrontEnd, expose, gamma, tint
from hri.evaluation.evaluate import cross_validate, evaluate_split
from hri.evaluation.noise import AddNoise, active_power, make_noise, mix_noise
from hri.evaluation.result import EvaluationItem, EvaluationResult, FoldResult
from hri.evaluation.sentences import (
    SentenceItem,
    SentenceResult,
    cross_validate_sentences,
)
from hri.evaluation.speech import adapting, evaluate_conditions

__all__ = [
    "AddNoise",
    "Condition",
    "EvaluationItem",
    "EvaluationResult",
    "FoldResult",
    "FrontEnd",
    "Reliability",
    "ReliabilityBin",
    "SentenceItem",
    "SentenceResult",
    "active_power",
    "adapting",
    "cross_validate",
    "cross_validate_sentences",
    "evaluate_conditions",
    "evaluate_split",
    "expose",
    "gamma",
    "make_noise",
    "mix_noise",
    "reliability",
    "tint",
]
