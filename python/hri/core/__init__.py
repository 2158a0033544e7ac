# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What every other package uses: errors, and libraries that are imported only when something needs them."""
