# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What scikit-learn asks of an estimator's kind; only scikit-learn calls this, so that it is there to be imported."""

from __future__ import annotations

from typing import Any


def make_tags(
    kind: str | None,
    *,
    rows: bool = True,
    binary_only: bool = False,
    requires_y: bool = False,
    transforms: bool = False,
) -> Any:
    """The ``sklearn.utils.Tags`` of an estimator.

    Parameters
    ----------
    kind : {"classifier", "clusterer", None}
    rows : bool
        Whether it takes a numeric matrix; recognisers take recordings.
    binary_only : bool
        Of a classifier of two classes.
    requires_y : bool
    transforms : bool
        Whether it has `transform`.
    """
    from sklearn.utils import ClassifierTags, InputTags, Tags, TargetTags, TransformerTags

    return Tags(
        estimator_type=kind,
        target_tags=TargetTags(required=requires_y),
        transformer_tags=TransformerTags(preserves_dtype=["float32"]) if transforms else None,
        classifier_tags=ClassifierTags(multi_class=not binary_only) if kind == "classifier" else None,
        regressor_tags=None,
        requires_fit=True,
        input_tags=InputTags(one_d_array=not rows, two_d_array=rows),
    )
