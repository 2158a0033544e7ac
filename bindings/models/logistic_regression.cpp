// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Logistic regression, with the methods of the other classifiers of rows.
#include "hri/models/classifiers/logistic_regression.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/options.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_integers;
using hri_bind::as_matrix;
using hri_bind::DoubleArray;
using hri_bind::to_array;

void bind_logistic_regression(py::module_& m) {
  using Model = hri::LogisticRegression;
  using Options = hri::LogisticRegressionOptions;
  hri_bind::bind_options<Options>(m, "Options of LogisticRegression.");
  py::class_<Model> cls(m, "LogisticRegression", "Logistic regression of two classes.");
  cls.def_static(
      "train",
      [](const DoubleArray& rows, const py::array& classes, int num_classes, const Options& o) {
        hri::require(num_classes == 2, "logistic regression takes two classes");
        const auto matrix = as_matrix(rows, "rows");
        const std::vector<int> labels = as_integers(classes, "classes");
        const std::vector<double> weights(labels.size(), 1.0);
        const py::gil_scoped_release release;
        return Model::train(matrix, labels, weights, o);
      },
      py::arg("rows"), py::arg("classes"), py::arg("num_classes"),
      py::arg_v("options", Options(), "..."),
      "Trains on rows (num_rows, dim) and classes (num_rows,) of 0 and 1.");
  cls.def(
      "decision_values",
      [](const Model& self, const DoubleArray& rows) {
        const auto matrix = as_matrix(rows, "rows");
        hri::require(matrix.cols() == self.dim(), "rows and model differ in their columns");
        hri::MatrixD values = hri::MatrixD::Zero(matrix.rows(), 2);
        for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
          values(r, 1) =
              self.log_odds({matrix.row(r).data(), static_cast<std::size_t>(matrix.cols())});
        }
        return to_array(values);
      },
      py::arg("rows"), "0 and the log odds of class 1, shape (num_rows, 2).");
  cls.def_property_readonly(
      "num_classes", [](const Model&) { return 2; }, "Number of classes.");
  cls.def_property_readonly("dim", &Model::dim, "Columns of the rows it takes.");
  cls.def_property_readonly(
      "weights", [](const Model& self) { return to_array(self.weights()); },
      "One for each column.");
  cls.def_property_readonly("bias", &Model::bias, "Constant term.");
  hri_bind::bind_files(cls);
}
