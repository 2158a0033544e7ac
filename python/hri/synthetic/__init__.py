# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Synthetic data: spoken words by a speech synthesiser, drawn signers, and the data sets made of them."""
