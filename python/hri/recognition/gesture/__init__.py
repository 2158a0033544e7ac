# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated signs and gestures: training and recognition."""

from hri.recognition.gesture.recognizer import GestureRecognizer

__all__ = ["GestureRecognizer"]
