# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Isolated words made of sub-word units."""

from hri.recognition.subword.recognizer import SubwordRecognizer

__all__ = ["SubwordRecognizer"]
