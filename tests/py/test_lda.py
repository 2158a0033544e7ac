# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Linear discriminant analysis against scikit-learn's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh
from sklearn.discriminant_analysis import LinearDiscriminantAnalysis

from hri._native import Lda, LdaOptions, ModelFile
from hri.core.errors import FormatError, InvalidArgument


def rows_and_classes(seed: int = 0, count: int = 300, dim: int = 6) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    classes = np.r_[np.arange(4), rng.integers(0, 4, count - 4)]
    means = rng.normal(size=(4, dim))
    rows = means[classes] + rng.normal(size=(count, dim)) @ rng.normal(size=(dim, dim))
    return (rows + 5).astype("f4"), classes


def assert_equal_up_to_sign(ours: np.ndarray, theirs: np.ndarray) -> None:
    assert ours.shape == theirs.shape
    signs = np.sign((ours * theirs).sum(axis=0))
    np.testing.assert_allclose(ours, theirs * signs, rtol=1e-3, atol=2e-4 * np.abs(theirs).max())


@pytest.mark.parametrize("num_components", [0, 1, 2])
def test_projection_is_scikit_learns(num_components: int) -> None:
    x, y = rows_and_classes()
    ours = Lda.train(x, y, 4, LdaOptions(num_components=num_components))
    theirs = LinearDiscriminantAnalysis(solver="svd", n_components=num_components or None).fit(x.astype("f8"), y)
    projected = ours.transform(x)
    assert projected.dtype == np.float32 and ours.num_components == (num_components or 3) and ours.dim == 6
    # Theirs have a variance of 1 within classes when divided by the rows, ours by the degrees of freedom.
    assert_equal_up_to_sign(projected, theirs.transform(x.astype("f8")) * np.sqrt((len(x) - 4) / len(x)))
    shares = ours.ratios / Lda.train(x, y, 4).ratios.sum()
    np.testing.assert_allclose(shares, theirs.explained_variance_ratio_, rtol=1e-3)


def test_shrunk_projection_solves_the_generalised_eigenproblem() -> None:
    x, y = rows_and_classes(1)
    ours = Lda.train(x, y, 4, LdaOptions(shrinkage=0.3))
    centred = x.astype("f8") - x.mean(axis=0, dtype="f8")
    means = np.stack([centred[y == c].mean(axis=0) for c in range(4)])
    within = (centred - means[y]).T @ (centred - means[y]) / (len(x) - 4)
    shrunk = 0.7 * within + 0.3 * np.trace(within) / 6 * np.eye(6)
    values, vectors = eigh(means[y].T @ means[y] / 3, shrunk)
    np.testing.assert_allclose(ours.ratios, values[:-4:-1], rtol=1e-4)
    assert_equal_up_to_sign(ours.transform(x), centred @ vectors[:, :-4:-1])


def test_classes_have_unit_spread_and_largest_entries_are_positive() -> None:
    x, y = rows_and_classes(2)
    lda = Lda.train(x, y, 4)
    projected = lda.transform(x).astype("f8")
    within = np.vstack([projected[y == c] - projected[y == c].mean(axis=0) for c in range(4)])
    np.testing.assert_allclose(within.T @ within / (len(x) - 4), np.eye(3), atol=1e-3)
    for row in lda.components:
        assert row[np.abs(row).argmax()] > 0
    assert (np.diff(lda.ratios) <= 0).all()


def test_columns_that_repeat_or_never_change_do_no_harm() -> None:
    x, y = rows_and_classes(3)
    wide = np.hstack([x, x[:, :1], np.full((len(x), 1), 7, dtype="f4")])
    assert_equal_up_to_sign(Lda.train(wide, y, 4).transform(wide), Lda.train(x, y, 4).transform(x).astype("f8"))


def test_loading_gives_the_same_projection(tmp_path: Path) -> None:
    x, y = rows_and_classes(4)
    lda = Lda.train(x, y, 4)
    file = ModelFile()
    lda.write(file, "lda.")
    file.write(str(tmp_path / "lda.hri"))
    loaded = Lda.read(ModelFile.read(str(tmp_path / "lda.hri")), "lda.")
    np.testing.assert_array_equal(loaded.transform(x), lda.transform(x))
    with pytest.raises(FormatError, match="other"):
        Lda.read(file, "other.")


def test_bad_input_is_named() -> None:
    x, y = rows_and_classes(5)
    with pytest.raises(InvalidArgument, match="num_components"):
        Lda.train(x, y, 4, LdaOptions(num_components=4))
    with pytest.raises(InvalidArgument, match="num_components"):
        LdaOptions(num_components=-1)
    with pytest.raises(InvalidArgument, match="shrinkage"):
        LdaOptions(shrinkage=1.5)
    with pytest.raises(InvalidArgument, match="do not vary"):
        Lda.train(np.ones((8, 2)), np.arange(8) % 2, 2)
    with pytest.raises(InvalidArgument, match="columns"):
        Lda.train(x, y, 4).transform(x[:, :2])
    broken = x.copy()
    broken[3, 1] = np.nan
    with pytest.raises(InvalidArgument, match="row 3"):
        Lda.train(broken, y, 4)
