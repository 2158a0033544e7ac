# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What a robot is: joints, limits, kinematics, masses, postures."""
