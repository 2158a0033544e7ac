# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The real NAO, by the services of its operating system NAOqi."""
