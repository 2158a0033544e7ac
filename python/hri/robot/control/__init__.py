# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What makes a robot follow a trajectory: commands, state, balance, braking."""
