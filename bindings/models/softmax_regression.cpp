// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Softmax regression, with the methods of the other classifiers of rows.
#include "hri/models/classifiers/softmax_regression.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/options.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_integers;
using hri_bind::as_matrix;
using hri_bind::FloatArray;
using hri_bind::to_array;

void bind_softmax_regression(py::module_& m) {
  using Model = hri::SoftmaxRegression;
  using Options = hri::SoftmaxRegressionOptions;
  hri_bind::bind_options<Options>(m, "Options of SoftmaxRegression.");
  py::class_<Model> cls(m, "SoftmaxRegression", "Logistic regression of many classes.");
  cls.def_static(
      "train",
      [](const FloatArray& rows, const py::array& classes, int num_classes, const Options& o) {
        const auto matrix = as_matrix(rows, "rows");
        const std::vector<int> labels = as_integers(classes, "classes");
        const py::gil_scoped_release release;
        return Model::train(matrix, labels, num_classes, o);
      },
      py::arg("rows"), py::arg("classes"), py::arg("num_classes"),
      py::arg_v("options", Options(), "..."),
      "Trains on rows (num_rows, dim) and classes (num_rows,) of 0..num_classes - 1.");
  cls.def(
      "decision_values",
      [](const Model& self, const FloatArray& rows) {
        const auto matrix = as_matrix(rows, "rows");
        hri::MatrixF values(matrix.rows(), self.num_classes());
        {
          const py::gil_scoped_release release;
          for (Eigen::Index r = 0; r < matrix.rows(); ++r)
            values.row(r) = self.scores(hri::row_span(matrix, r)).transpose();
        }
        return to_array(values);
      },
      py::arg("rows"), "Log posteriors but for a constant, shape (num_rows, num_classes).");
  cls.def_property_readonly("num_classes", &Model::num_classes, "Number of classes.");
  cls.def_property_readonly("dim", &Model::dim, "Columns of the rows it takes.");
  hri_bind::bind_files(cls);
}
