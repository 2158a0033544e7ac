# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The robot HOAP-2: joints, trajectories, gestures and simulation."""
