# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Models of rows against scikit-learn and SciPy, and the Python side of them: shapes, errors, files."""

from __future__ import annotations

import numpy as np
import pytest

from hri import _native
from hri.core.errors import FormatError, InvalidArgument

sklearn = pytest.importorskip("sklearn")


def blobs(num_classes: int, per_class: int, spread: float, seed: int, dim: int = 6) -> tuple:
    """Rows around random centres, float32, and their classes."""
    rng = np.random.default_rng(seed)
    centres = np.random.default_rng(0).normal(0, spread, (num_classes, dim))
    classes = np.repeat(np.arange(num_classes), per_class)
    rows = centres[classes] + rng.normal(size=(classes.size, dim))
    return rows.astype("f4"), classes


def test_shared_covariance_matches_linear_discriminant_analysis() -> None:
    from sklearn.discriminant_analysis import LinearDiscriminantAnalysis

    rows, classes = blobs(4, 30, 1.0, 1)
    test, _ = blobs(4, 30, 1.0, 2)
    for shrinkage in (0.0, 0.3):
        options = _native.GaussianBayesOptions(covariance="shared", shrinkage=shrinkage)
        ours = _native.GaussianBayes.train(rows, classes, 4, options)
        peer = LinearDiscriminantAnalysis(solver="lsqr", shrinkage=shrinkage).fit(rows, classes)
        values = ours.decision_values(test).astype("f8")
        log_posteriors = values - np.logaddexp.reduce(values, axis=1, keepdims=True)
        np.testing.assert_allclose(log_posteriors, peer.predict_log_proba(test), rtol=1e-3, atol=1e-4)
        np.testing.assert_array_equal(values.argmax(axis=1), peer.predict(test))


def test_diagonal_covariance_matches_naive_bayes() -> None:
    from sklearn.naive_bayes import GaussianNB

    rows, classes = blobs(3, 30, 1.5, 3)
    test, _ = blobs(3, 20, 1.5, 4)
    options = _native.GaussianBayesOptions(covariance="diagonal", shrinkage=0.0)
    ours = _native.GaussianBayes.train(rows, classes, 3, options).decision_values(test)
    peer = GaussianNB(var_smoothing=1e-12).fit(rows.astype("f8"), classes)
    expected = peer.predict_joint_log_proba(test.astype("f8"))
    np.testing.assert_allclose(ours, expected, rtol=1e-4, atol=1e-4)


def test_softmax_regression_matches_scikit_learn() -> None:
    from sklearn.linear_model import LogisticRegression
    from sklearn.preprocessing import StandardScaler

    rows, classes = blobs(4, 60, 1.5, 11)
    test, _ = blobs(4, 20, 1.5, 12)
    options = _native.SoftmaxRegressionOptions(penalty=20.0, max_iterations=1000)
    ours = _native.SoftmaxRegression.train(rows, classes, 4, options).decision_values(test)
    scaler = StandardScaler().fit(rows.astype("f8"))
    peer = LogisticRegression(C=1 / 20, tol=1e-8, max_iter=1000).fit(scaler.transform(rows), classes)
    expected = peer.predict_log_proba(scaler.transform(test))
    log_posteriors = ours - np.log(np.exp(ours).sum(axis=1, keepdims=True))
    np.testing.assert_allclose(log_posteriors, expected, atol=0.03)


def test_full_covariance_matches_scipy() -> None:
    from scipy.stats import multivariate_normal
    from sklearn.covariance import empirical_covariance, shrunk_covariance

    rows, classes = blobs(3, 40, 2.0, 5)
    test, _ = blobs(3, 20, 2.0, 6)
    options = _native.GaussianBayesOptions(covariance="full", shrinkage=0.2)
    ours = _native.GaussianBayes.train(rows, classes, 3, options).log_densities(test)
    for c in range(3):
        own = rows[classes == c].astype("f8")
        covariance = shrunk_covariance(empirical_covariance(own), 0.2)
        expected = multivariate_normal(own.mean(axis=0), covariance).logpdf(test.astype("f8"))
        np.testing.assert_allclose(ours[:, c], expected, rtol=1e-4, atol=1e-4)


@pytest.mark.parametrize("num_neighbours", [1, 4, 7])
def test_knn_shares_match_scikit_learn(num_neighbours: int) -> None:
    from sklearn.neighbors import KNeighborsClassifier

    rows, classes = blobs(3, 30, 0.7, 7)
    test, _ = blobs(3, 30, 0.7, 8)
    options = _native.KnnOptions(num_neighbours=num_neighbours)
    ours = _native.Knn.train(rows, classes, 3, options)
    peer = KNeighborsClassifier(num_neighbours, algorithm="brute").fit(rows, classes)
    # Ours adds up to 2e-3 to rank classes with as many neighbours.
    np.testing.assert_allclose(ours.decision_values(test), peer.predict_proba(test), atol=2e-3)
    distances, _ = peer.kneighbors(test, 1)
    nearest = [ours.nearest_distance(row) for row in test]
    np.testing.assert_allclose(nearest, distances[:, 0], rtol=1e-4)


@pytest.mark.parametrize("cost", [0.01, 1.0, 10.0])
def test_linear_svm_matches_liblinear(cost: float) -> None:
    from sklearn.svm import LinearSVC

    rows, classes = blobs(3, 40, 0.8, 9)
    options = _native.LinearSvmOptions(cost=cost, tolerance=1e-5, max_iterations=100000)
    ours = _native.LinearSvm.train(rows, classes, 3, options)
    peer = LinearSVC(C=cost, tol=1e-8, max_iter=1000000, dual=True, random_state=0).fit(rows, classes)
    np.testing.assert_allclose(ours.weights, peer.coef_, rtol=1e-3, atol=1e-4)
    np.testing.assert_allclose(ours.biases, peer.intercept_, rtol=1e-3, atol=1e-4)
    np.testing.assert_allclose(ours.decision_values(rows), peer.decision_function(rows), rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize("name", ["GaussianBayes", "Knn", "LinearSvm"])
def test_scores_of_a_row_are_those_it_has_among_others(name: str) -> None:
    model_type, options = getattr(_native, name), getattr(_native, f"{name}Options")()
    rows, classes = blobs(3, 40, 0.8, 11)
    rows += np.float32(1000)  # squares of distances by |x|^2 - 2 x.y + |y|^2 would be lost
    model = model_type.train(rows, classes, 3, options)
    together = model.decision_values(rows)
    assert together.dtype == np.float32 and together.shape == (120, 3)
    np.testing.assert_array_equal([model.decision_values(row) for row in rows], together)
    np.testing.assert_array_equal(model.decision_values(rows[::2]), together[::2])
    rows[7, 1] = np.nan
    with pytest.raises(InvalidArgument, match="row 7, column 1"):
        model.decision_values(rows)


@pytest.mark.parametrize("shape", [(200, 12), (9, 30)])
def test_pca_matches_scikit_learn(shape: tuple[int, int]) -> None:
    from sklearn.decomposition import PCA

    rows = (np.random.default_rng(10).normal(size=shape) * np.arange(1, shape[1] + 1)).astype("f4")
    ours = _native.Pca.train(rows, 5)
    peer = PCA(5, svd_solver="full").fit(rows.astype("f8"))
    signs = np.sign((ours.components * peer.components_).sum(axis=1, keepdims=True))
    np.testing.assert_allclose(ours.components, signs * peer.components_, atol=1e-5)
    np.testing.assert_allclose(ours.variances, peer.explained_variance_, rtol=1e-5)
    expected = peer.transform(rows.astype("f8")) * signs.T
    np.testing.assert_allclose(ours.transform(rows), expected, atol=1e-4 * np.abs(expected).max())


def test_kmeans_matches_scikit_learn() -> None:
    from sklearn.cluster import KMeans

    rows, _ = blobs(5, 60, 4.0, 11)
    first = rows[::60].copy()
    options = _native.CodebookOptions(max_iterations=100, tolerance=0.0)
    ours = _native.Codebook.train_kmeans(rows, first, options)
    peer = KMeans(5, init=first, n_init=1, max_iter=100, tol=0, algorithm="lloyd").fit(rows)
    np.testing.assert_allclose(ours.centroids, peer.cluster_centers_, rtol=1e-4, atol=1e-4)
    np.testing.assert_array_equal(ours.quantise(rows), peer.predict(rows))
    assert ours.distortion(rows) == pytest.approx(peer.inertia_ / len(rows), rel=1e-4)


def test_lbg_reaches_the_distortion_of_kmeans() -> None:
    from sklearn.cluster import KMeans

    rows, _ = blobs(8, 100, 2.0, 12)
    ours = _native.Codebook.train_lbg(rows, _native.CodebookOptions(num_codewords=32))
    peer = KMeans(32, n_init=1, random_state=0).fit(rows)
    assert len(ours) == 32
    assert ours.distortion(rows) < 1.05 * peer.inertia_ / len(rows)


def test_distances_match_scipy() -> None:
    from scipy.spatial import distance

    a, b = np.abs(np.random.default_rng(13).normal(size=(2, 9))).astype("f4")
    for kind, peer in (("euclidean", "euclidean"), ("manhattan", "cityblock"), ("cosine", "cosine")):
        ours = _native.distance(kind, a, b)
        assert ours == pytest.approx(getattr(distance, peer)(a.astype("f8"), b.astype("f8")), rel=1e-9)


def test_gaussian_bhattacharyya_bounds_the_overlap() -> None:
    covariance = np.array([[2.0, 0.5], [0.5, 1.0]])
    mean = np.array([1.0, 2.0])
    # One-dimensional check by quadrature: the integral of sqrt(p q) is exp(-distance).
    x = np.linspace(-30, 30, 200001)

    def density(m: float, v: float) -> np.ndarray:
        return np.exp(-0.5 * (x - m) ** 2 / v) / np.sqrt(2 * np.pi * v)

    overlap = np.sum(np.sqrt(density(0, 1) * density(3, 4))) * (x[1] - x[0])
    ours = _native.bhattacharyya_gaussian([0.0], [[1.0]], [3.0], [[4.0]])
    assert np.exp(-ours) == pytest.approx(overlap, rel=1e-9)
    assert _native.bhattacharyya_gaussian(mean, covariance, mean, covariance) == pytest.approx(0.0)


def test_possibilities_give_an_honest_confidence() -> None:
    possibility, necessity = _native.possibilities(np.log([0.5, 0.4, 0.001]))
    np.testing.assert_allclose(possibility, [1.0, 0.8, 0.002], rtol=1e-5)
    np.testing.assert_allclose(necessity, [0.2, 0.0, 0.0], atol=1e-6)
    assert _native.possibility_of([0.9, 0.7, 0.8, 0.3], [0, 2]) == 0.9
    assert _native.necessity_of([0.9, 0.7, 0.8, 0.3], [0, 2]) == pytest.approx(0.3)


@pytest.mark.parametrize("metric", ["euclidean", "manhattan", "mahalanobis"])
def test_distances_to_class_means_match_scipy(metric: str) -> None:
    from scipy.spatial.distance import cdist
    from sklearn.covariance import empirical_covariance, shrunk_covariance

    rows, classes = blobs(4, 30, 1.0, 20)
    test, _ = blobs(4, 10, 1.0, 21)
    options = _native.DistanceClassifierOptions(metric=metric, shrinkage=0.2)
    ours = _native.DistanceClassifier.train(rows, classes, 4, options).decision_values(test)
    own = rows.astype("f8")
    means = np.stack([own[classes == c].mean(axis=0) for c in range(4)])
    within = shrunk_covariance(empirical_covariance(own - means[classes], assume_centered=True), 0.2)
    name = {"manhattan": "cityblock"}.get(metric, metric)
    peer = cdist(test, means, name, **({"VI": np.linalg.inv(within)} if metric == "mahalanobis" else {}))
    np.testing.assert_allclose(ours, -peer, rtol=1e-5)


def test_nearest_mean_decides_as_scikit_learn() -> None:
    from sklearn.neighbors import NearestCentroid

    rows, classes = blobs(5, 30, 1.0, 22)
    test, _ = blobs(5, 40, 1.0, 23)
    ours = _native.DistanceClassifier.train(rows, classes, 5).decision_values(test).argmax(axis=1)
    np.testing.assert_array_equal(ours, NearestCentroid().fit(rows, classes).predict(test))


def test_bhattacharyya_distances_are_those_of_gaussians() -> None:
    from sklearn.covariance import empirical_covariance, shrunk_covariance

    rows, classes = blobs(3, 40, 1.0, 24)
    test, _ = blobs(3, 5, 1.0, 25)
    options = _native.DistanceClassifierOptions(metric="bhattacharyya", shrinkage=0.1)
    ours = _native.DistanceClassifier.train(rows, classes, 3, options).decision_values(test)
    own = rows.astype("f8")
    means = np.stack([own[classes == c].mean(axis=0) for c in range(3)])
    within = shrunk_covariance(empirical_covariance(own - means[classes], assume_centered=True), 0.1)
    for c in range(3):
        covariance = shrunk_covariance(empirical_covariance(own[classes == c]), 0.1)
        mean = 0.5 * (covariance + within)
        logs = [np.linalg.slogdet(m)[1] for m in (mean, covariance, within)]
        for row, value in zip(test.astype("f8"), ours[:, c], strict=True):
            squared = (row - means[c]) @ np.linalg.solve(mean, row - means[c])
            assert -value == pytest.approx(squared / 8 + 0.5 * (logs[0] - 0.5 * (logs[1] + logs[2])), rel=1e-4)


def test_possibilities_of_classes_are_densities_over_the_largest() -> None:
    from scipy.stats import multivariate_normal

    rows, classes = blobs(3, 40, 1.0, 26)
    options = _native.GaussianBayesOptions(covariance="full", shrinkage=0.0)
    model = _native.PossibilityClassifier.train(rows, classes, 3, options)
    own = rows.astype("f8")
    gaussians = [
        multivariate_normal(own[classes == c].mean(axis=0), np.cov(own[classes == c].T, bias=True)) for c in range(3)
    ]
    for row in rows[::7]:
        densities = np.array([g.pdf(row.astype("f8")) for g in gaussians])
        possibility, necessity = model.classify(row)
        np.testing.assert_allclose(possibility, densities / densities.max(), rtol=1e-4)
        others = np.sort(possibility)[-2]
        assert necessity[possibility.argmax()] == pytest.approx(1 - others, abs=1e-6) and (necessity > 0).sum() <= 1
        np.testing.assert_allclose(model.decision_values(row), np.log(possibility), rtol=1e-3, atol=1e-5)


CLASSIFIERS = [
    _native.LinearSvm,
    _native.GaussianBayes,
    _native.Knn,
    _native.DistanceClassifier,
    _native.PossibilityClassifier,
]


@pytest.mark.parametrize("model", CLASSIFIERS)
def test_classifiers_take_rows_and_matrices(model: type) -> None:
    rows, classes = blobs(3, 20, 4.0, 14)
    trained = model.train(rows, classes, 3)
    values = trained.decision_values(rows)
    assert values.shape == (60, 3) and values.dtype == np.float32
    np.testing.assert_array_equal(trained.decision_values(rows[7]), values[7])
    np.testing.assert_array_equal(trained.decision_values(rows.astype("f8")), values)
    np.testing.assert_array_equal(trained.decision_values(np.asfortranarray(rows)), values)
    assert trained.decision_values(rows[:0]).shape == (0, 3)


@pytest.mark.parametrize("model", CLASSIFIERS)
def test_classifiers_refuse_bad_input_by_name(model: type) -> None:
    rows, classes = blobs(3, 5, 4.0, 15)
    with pytest.raises(InvalidArgument, match="class 3 has no row"):
        model.train(rows, classes, 4)
    with pytest.raises(ValueError, match="classes must be one-dimensional integers"):
        model.train(rows, classes.astype("f8"), 3)
    trained = model.train(rows, classes.astype("u1"), 3)
    rows[4, 2] = np.inf
    with pytest.raises(InvalidArgument, match="row 4, column 2"):
        model.train(rows, classes, 3)
    with pytest.raises(InvalidArgument, match=r"row\[2\]"):
        trained.decision_values(rows[4])


@pytest.mark.parametrize("model", CLASSIFIERS)
def test_classifiers_score_the_same_after_a_model_file(model: type) -> None:
    rows, classes = blobs(3, 20, 1.0, 16)
    trained = model.train(rows, classes, 3)
    file = _native.ModelFile()
    trained.write(file, "c.")
    np.testing.assert_array_equal(model.read(file, "c.").decision_values(rows), trained.decision_values(rows))
    with pytest.raises(FormatError):
        model.read(file, "d.")
