// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The network of sequences of frames.
#include "hri/models/network/sequence_network.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/options.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_integers;
using hri_bind::as_matrix;
using hri_bind::FloatArray;
using hri_bind::to_array;

void bind_sequence_network(py::module_& m) {
  using Model = hri::SequenceNetwork;
  using Options = hri::SequenceNetworkOptions;
  hri_bind::bind_options<Options>(m, "Options of SequenceNetwork.");
  py::class_<Model> cls(m, "SequenceNetwork", "Time-channel separable convolutions and softmax.");
  cls.def_static(
      "train",
      [](const std::vector<FloatArray>& sequences, const py::array& classes, int num_classes,
         const Options& o) {
        std::vector<hri::MatrixF> frames;
        frames.reserve(sequences.size());
        for (const FloatArray& sequence : sequences)
          frames.emplace_back(as_matrix(sequence, "sequences"));
        const std::vector<int> labels = as_integers(classes, "classes");
        if (labels.size() != frames.size())
          throw hri::InvalidArgument("sequences and classes differ in number");
        const py::gil_scoped_release release;
        const auto as_it_is = [&](std::size_t i, hri::Random*, hri::MatrixF* to) {
          *to = frames[i];
        };
        return Model::train(as_it_is, labels, num_classes, o);
      },
      py::arg("sequences"), py::arg("classes"), py::arg("num_classes"),
      py::arg_v("options", Options(), "..."),
      "Trains on sequences (num_frames, dim) and classes (num_sequences,) of 0..num_classes - 1.");
  cls.def(
      "log_posteriors",
      [](const Model& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        hri::VectorF values;
        {
          const py::gil_scoped_release release;
          values = self.log_posteriors(matrix);
        }
        return to_array(values);
      },
      py::arg("frames"), "Log posterior of every class, shape (num_classes,).");
  cls.def_property_readonly("num_classes", &Model::num_classes, "Number of classes.");
  cls.def_property_readonly("dim", &Model::dim, "Columns of the frames it takes.");
  hri_bind::bind_files(cls);
}
