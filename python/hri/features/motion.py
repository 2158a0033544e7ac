# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Features of moving gestures, from the masks of a hand."""

from __future__ import annotations

from hri._native import HybridFeatureComputer, HybridFeatureOptions, direction_code


def hybrid_column_names(options: HybridFeatureOptions | None = None) -> list[str]:
    """Names of the columns that `HybridFeatureComputer` gives for the same options.

    Parameters
    ----------
    options : HybridFeatureOptions, optional

    Returns
    -------
    list of str

    Examples
    --------
    >>> hybrid_column_names(HybridFeatureOptions(use_moments=False))
    ['orientation', 'code_from_middle', 'code_of_step', 'speed']
    """
    chosen = options or HybridFeatureOptions()
    shape = chosen.moments
    pairs = [(m, n) for m in range(shape.num_scales) for n in range(2 ** (m + 1) + 1)]
    names = [f"b{b}_m{m}_n{n}" for b in range(shape.num_frequencies) for m, n in pairs] if chosen.use_moments else []
    angles = ["orientation"] if chosen.use_orientation else []
    angles += ["code_from_middle", "code_of_step"] if chosen.use_chain_codes else []
    parts = ("",) if chosen.angles == "number" else ("_cosine", "_sine")
    names += [angle + part for angle in angles for part in parts]
    return [*names, "speed"] if chosen.use_speed else names


__all__ = ["HybridFeatureComputer", "HybridFeatureOptions", "direction_code", "hybrid_column_names"]
