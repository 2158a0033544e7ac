# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Stands for the compiled module in packages built with HRI_BUILD_VISION=OFF."""

raise ImportError(
    "this libhri was built without vision (hands in camera pictures): "
    "install it without -C cmake.define.HRI_BUILD_VISION=OFF"
)
