# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Trajectories: reading, writing, checking, shaping; the gestures that the robots know."""
