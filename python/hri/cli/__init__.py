# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The command ``hri``: data on standard output, messages on standard error."""
