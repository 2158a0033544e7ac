# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What pages of hri are made of: one style sheet, and parts that show decisions, the conversation and the robot."""

from hri.page.components import COMPONENTS, component, in_one_file
from hri.page.figure import figure

__all__ = ["COMPONENTS", "component", "figure", "in_one_file"]
