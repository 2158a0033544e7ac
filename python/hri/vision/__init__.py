# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Hands in pictures: silhouettes, landmarks, drawings and reports of what was found."""
