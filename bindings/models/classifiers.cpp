// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Models of single rows: PCA, classifiers, distances, possibility.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <type_traits>
#include <utility>

#include "core/options.hpp"
#include "hri/models/classifiers/distance_classifier.hpp"
#include "hri/models/classifiers/distances.hpp"
#include "hri/models/classifiers/gaussian_bayes.hpp"
#include "hri/models/classifiers/knn.hpp"
#include "hri/models/classifiers/lda.hpp"
#include "hri/models/classifiers/linear_svm.hpp"
#include "hri/models/classifiers/pca.hpp"
#include "hri/models/classifiers/possibility_classifier.hpp"
#include "hri/models/classifiers/rbf_classifier.hpp"
#include "hri/models/possibility/possibility.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_integers;
using hri_bind::as_matrix;
using hri_bind::as_span;
using hri_bind::as_vector;
using hri_bind::bind_files;
using hri_bind::DoubleArray;
using hri_bind::FloatArray;
using hri_bind::to_array;

namespace {

// Whether a model takes many rows at once.
template <class Model, class = void>
inline constexpr bool takes_matrices = false;
template <class Model>
inline constexpr bool
    takes_matrices<Model, std::void_t<decltype(std::declval<const Model&>().decision_values(
                              std::declval<hri::ConstMatrixRefF>()))>> = true;

using OneRow = hri::Span<const float>;

// Applies one const member to a row, giving a vector, or another one to a matrix.
template <class Model>
py::array_t<float> row_or_rows(const Model& model, const FloatArray& rows,
                               hri::VectorF (Model::*of_row)(OneRow) const,
                               hri::MatrixF (Model::*of_rows)(hri::ConstMatrixRefF) const) {
  if (rows.ndim() == 1) return to_array((model.*of_row)(as_span(rows, "rows")));
  const auto matrix = as_matrix(rows, "rows");
  hri::MatrixF values;
  {
    const py::gil_scoped_release release;
    values = (model.*of_rows)(matrix);
  }
  return to_array(values);
}

// Applies a const member that takes one row to a row, giving a vector, or to every row of a matrix.
template <class Model>
py::array_t<float> per_row(const Model& model, const FloatArray& rows,
                           hri::VectorF (Model::*method)(OneRow) const) {
  if (rows.ndim() == 1) return to_array((model.*method)(as_span(rows, "rows")));
  const auto matrix = as_matrix(rows, "rows");
  hri::MatrixF values(matrix.rows(), model.num_classes());
  {
    const py::gil_scoped_release release;
    for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
      values.row(r) =
          (model.*method)({matrix.row(r).data(), static_cast<std::size_t>(matrix.cols())})
              .transpose();
    }
  }
  return to_array(values);
}

// What the classifiers of rows share.
template <class Model, class Options>
void bind_classifier(py::class_<Model>& cls, const std::function<void(Options*)>& prepare) {
  cls.def_static(
      "train",
      [prepare](const FloatArray& rows, const py::array& classes, int num_classes,
                Options options) {
        const auto matrix = as_matrix(rows, "rows");
        const std::vector<int> labels = as_integers(classes, "classes");
        if (prepare) prepare(&options);
        const py::gil_scoped_release release;
        return Model::train(matrix, labels, num_classes, options);
      },
      py::arg("rows"), py::arg("classes"), py::arg("num_classes"),
      py::arg_v("options", Options(), "..."),
      "Trains on rows (num_rows, dim), float32, and classes (num_rows,) in 0..num_classes - 1.\n\n"
      "Raises InvalidArgument for values not finite (names the row) or a class without a row.");
  cls.def(
      "decision_values",
      [](const Model& self, const FloatArray& rows) {
        if constexpr (takes_matrices<Model>) {
          return row_or_rows<Model>(self, rows, &Model::decision_values, &Model::decision_values);
        } else {
          return per_row(self, rows, &Model::decision_values);
        }
      },
      py::arg("rows"),
      "Scores, larger is likelier: (num_classes,) for one row, (num_rows, num_classes) for a "
      "matrix.");
  cls.def_property_readonly("num_classes", &Model::num_classes, "Number of classes.");
  cls.def_property_readonly("dim", &Model::dim, "Columns of the rows it takes.");
  bind_files(cls);
}

void bind_pca(py::module_& m) {
  py::class_<hri::Pca> cls(m, "Pca", "Principal component analysis (thesis eq. 6.11-6.14).");
  cls.def_static(
      "train",
      [](const FloatArray& rows, int num_components) {
        const auto matrix = as_matrix(rows, "rows");
        const py::gil_scoped_release release;
        return hri::Pca::train(matrix, num_components);
      },
      py::arg("rows"), py::arg("num_components"));
  cls.def(
      "transform",
      [](const hri::Pca& self, const FloatArray& rows) {
        return to_array(self.transform(as_matrix(rows, "rows")));
      },
      py::arg("rows"), "Shape (num_rows, num_components), float32.");
  cls.def_property_readonly("num_components", &hri::Pca::num_components);
  cls.def_property_readonly("dim", &hri::Pca::dim, "Columns of the rows it takes.");
  cls.def_property_readonly(
      "components", [](const hri::Pca& self) { return to_array(self.components()); },
      "Directions, a row each.");
  cls.def_property_readonly(
      "mean", [](const hri::Pca& self) { return to_array(self.mean()); },
      "Mean of the rows trained on.");
  cls.def_property_readonly(
      "variances", [](const hri::Pca& self) { return to_array(self.variances()); },
      "Variance along every component.");
  bind_files(cls);
}

void bind_lda(py::module_& m) {
  hri_bind::bind_options<hri::LdaOptions>(m, "Options of Lda.");
  py::class_<hri::Lda> cls(m, "Lda", "Linear discriminant analysis.");
  cls.def_static(
      "train",
      [](const FloatArray& rows, const py::array& classes, int num_classes,
         const hri::LdaOptions& how) {
        const auto matrix = as_matrix(rows, "rows");
        const std::vector<int> labels = as_integers(classes, "classes");
        const py::gil_scoped_release release;
        return hri::Lda::train(matrix, labels, num_classes, how);
      },
      py::arg("rows"), py::arg("classes"), py::arg("num_classes"),
      py::arg_v("options", hri::LdaOptions(), "..."),
      "Directions along which classes (num_rows,) in 0..num_classes - 1 lie max_displacement "
      "apart.");
  cls.def(
      "transform",
      [](const hri::Lda& self, const FloatArray& rows) {
        return to_array(self.transform(as_matrix(rows, "rows")));
      },
      py::arg("rows"), "Shape (num_rows, num_components), float32.");
  cls.def_property_readonly("num_components", &hri::Lda::num_components);
  cls.def_property_readonly("dim", &hri::Lda::dim, "Columns of the rows it takes.");
  cls.def_property_readonly(
      "components", [](const hri::Lda& self) { return to_array(self.components()); },
      "Directions, a row each.");
  cls.def_property_readonly(
      "mean", [](const hri::Lda& self) { return to_array(self.mean()); },
      "Mean of the rows trained on.");
  cls.def_property_readonly(
      "ratios", [](const hri::Lda& self) { return to_array(self.ratios()); },
      "Variance between classes over variance within, falling.");
  bind_files(cls);
}

void bind_svm(py::module_& m) {
  hri_bind::bind_options<hri::LinearSvmOptions>(m, "Options of LinearSvm.");
  py::class_<hri::LinearSvm> cls(m, "LinearSvm",
                                 "Linear support vector machines, one class against the rest.");
  bind_classifier<hri::LinearSvm, hri::LinearSvmOptions>(
      cls, [](hri::LinearSvmOptions* o) { o->should_stop = hri_bind::interrupted; });
  cls.def_property_readonly(
      "weights", [](const hri::LinearSvm& self) { return to_array(self.weights()); },
      "Weights, as trained.");
  cls.def_property_readonly(
      "biases", [](const hri::LinearSvm& self) { return to_array(self.biases()); },
      "Constant terms, one a class.");
}

void bind_rbf(py::module_& m) {
  hri_bind::bind_options<hri::RbfClassifierOptions>(m, "Options of RbfClassifier.");
  py::class_<hri::RbfClassifier> cls(
      m, "RbfClassifier",
      "Least-squares support vector machines with a radial kernel, one class against the rest.");
  bind_classifier<hri::RbfClassifier, hri::RbfClassifierOptions>(
      cls, [](hri::RbfClassifierOptions* o) { o->should_stop = hri_bind::interrupted; });
  cls.def_property_readonly("num_rows", &hri::RbfClassifier::num_rows);
}

void bind_bayes(py::module_& m) {
  hri_bind::bind_options<hri::GaussianBayesOptions>(m, "Options of GaussianBayes.");
  py::class_<hri::GaussianBayes> cls(m, "GaussianBayes",
                                     "Bayes classifier with one Gaussian a class.");
  bind_classifier<hri::GaussianBayes, hri::GaussianBayesOptions>(cls, {});
  cls.def(
      "log_densities",
      [](const hri::GaussianBayes& self, const FloatArray& rows) {
        return row_or_rows<hri::GaussianBayes>(self, rows, &hri::GaussianBayes::log_densities,
                                               &hri::GaussianBayes::log_densities);
      },
      py::arg("rows"), "log p(row | class), shapes as decision_values.");
}

void bind_distance_classifier(py::module_& m) {
  hri_bind::bind_options<hri::DistanceClassifierOptions>(m, "Options of DistanceClassifier.");
  py::class_<hri::DistanceClassifier> cls(
      m, "DistanceClassifier",
      "The class whose mean is nearest (thesis table 6.5); decision values are negative "
      "distances.");
  bind_classifier<hri::DistanceClassifier, hri::DistanceClassifierOptions>(cls, {});
}

void bind_possibility_classifier(py::module_& m) {
  py::class_<hri::PossibilityClassifier> cls(
      m, "PossibilityClassifier",
      "Gaussian class densities divided by the largest (thesis eq. 5.14-5.15); decision values are "
      "log possibilities.");
  bind_classifier<hri::PossibilityClassifier, hri::GaussianBayesOptions>(cls, {});
  cls.def(
      "classify",
      [](const hri::PossibilityClassifier& self, const FloatArray& row) {
        const hri::Possibilities p = self.classify(as_span(row, "row"));
        return py::make_tuple(to_array(p.possibility), to_array(p.necessity));
      },
      py::arg("row"), "Possibility and necessity of every class, each of shape (num_classes,).");
}

void bind_knn(py::module_& m) {
  hri_bind::bind_options<hri::KnnOptions>(m, "Options of Knn.");
  py::class_<hri::Knn> cls(m, "Knn", "k nearest neighbours by Euclidean distance.");
  bind_classifier<hri::Knn, hri::KnnOptions>(cls, {});
  cls.def(
      "nearest_distance",
      [](const hri::Knn& self, const FloatArray& row) {
        return self.nearest_distance(as_span(row, "row"));
      },
      py::arg("row"));
}

void bind_distances(py::module_& m) {
  m.def(
      "distance",
      [](hri::Distance kind, const FloatArray& a, const FloatArray& b) {
        return hri::distance(kind, as_span(a, "a"), as_span(b, "b"));
      },
      py::arg("kind"), py::arg("a"), py::arg("b"), "Distance of two vectors of one length.");
  m.def(
      "bhattacharyya_gaussian",
      [](const DoubleArray& mean_a, const DoubleArray& covariance_a, const DoubleArray& mean_b,
         const DoubleArray& covariance_b) {
        return hri::bhattacharyya_gaussian(
            as_vector(mean_a, "mean_a"), as_matrix(covariance_a, "covariance_a"),
            as_vector(mean_b, "mean_b"), as_matrix(covariance_b, "covariance_b"));
      },
      py::arg("mean_a"), py::arg("covariance_a"), py::arg("mean_b"), py::arg("covariance_b"));
}

void bind_possibility(py::module_& m) {
  m.def(
      "possibility_of",
      [](const DoubleArray& distribution, const std::vector<int>& event) {
        return hri::possibility_of(as_span(distribution, "distribution"), event);
      },
      py::arg("distribution"), py::arg("event"), "Pi(A) = max over the event (thesis eq. 4.1).");
  m.def(
      "necessity_of",
      [](const DoubleArray& distribution, const std::vector<int>& event) {
        return hri::necessity_of(as_span(distribution, "distribution"), event);
      },
      py::arg("distribution"), py::arg("event"), "N(A) = 1 - Pi(not A) (thesis eq. 4.2).");
  m.def(
      "possibilities",
      [](const FloatArray& log_densities) {
        const hri::Possibilities p = hri::possibilities(as_vector(log_densities, "log_densities"));
        return py::make_tuple(to_array(p.possibility), to_array(p.necessity));
      },
      py::arg("log_densities"),
      "Possibility and necessity of every class from log densities (thesis eq. 5.14).");
}

}  // namespace

void bind_classifiers(py::module_& m) {
  bind_distances(m);
  bind_possibility(m);
  bind_pca(m);
  bind_lda(m);
  bind_svm(m);
  bind_rbf(m);
  bind_bayes(m);
  bind_knn(m);
  bind_distance_classifier(m);
  bind_possibility_classifier(m);
}
