# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A drawn signer: round shapes on a height field, a hand with bones, a body, light, a camera."""
