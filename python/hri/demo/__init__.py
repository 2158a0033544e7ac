# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""``hri demo``: from a word and a sign to a moving robot, on recordings that it makes itself."""
