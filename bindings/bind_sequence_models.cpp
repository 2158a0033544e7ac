// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The possibility-theory HMM set.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "hri/models/possibilistic_hmm.hpp"
#include "model_inputs.hpp"
#include "options.hpp"

namespace py = pybind11;
using hri_bind::as_integers;
using hri_bind::as_symbols;
using hri_bind::bind_files;
using hri_bind::to_array;

void bind_hmm(py::module_& m);

namespace {

void bind_possibilistic(py::module_& m) {
  using Model = hri::PossibilisticHmmSet;
  using Options = hri::PossibilisticHmmOptions;
  py::enum_<hri::Conjunction>(m, "Conjunction")
      .value("product", hri::Conjunction::product)
      .value("min", hri::Conjunction::min)
      .value("max", hri::Conjunction::max);
  py::class_<Options> options(m, "PossibilisticHmmOptions", "Options of PossibilisticHmmSet.");
  hri_bind::options(options)
      .field("topology", &Options::topology)
      .field("num_symbols", &Options::num_symbols)
      .field("conjunction", &Options::conjunction)
      .field("conditioned", &Options::conditioned)
      .field("max_iterations", &Options::max_iterations)
      .field("tolerance", &Options::tolerance)
      .field("emission_floor", &Options::emission_floor)
      .field("seed", &Options::seed);
  py::class_<Model> cls(
      m, "PossibilisticHmmSet",
      "Possibility-theory HMMs of all classes, trained and scaled together (thesis chapter 4).");
  cls.def_static(
      "train",
      [](const std::vector<std::vector<py::array>>& per_class, Options o) {
        std::vector<std::vector<hri::SymbolSequence>> symbols;
        symbols.reserve(per_class.size());
        for (const auto& sequences : per_class) symbols.push_back(as_symbols(sequences));
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return Model::train(symbols, o);
      },
      py::arg("per_class"), py::arg("options"),
      "per_class[c] lists the symbol sequences of class c.");
  cls.def_static("from_hmms", &Model::from_hmms, py::arg("models"), py::arg("conjunction"),
                 py::arg("conditioned") = true);
  cls.def(
      "log_possibilities",
      [](const Model& self, const py::array& symbols) {
        return to_array(self.log_possibilities(as_integers(symbols, "symbols")));
      },
      py::arg("symbols"),
      "log possibility of the symbols under each class, float32, shape (num_classes,).");
  cls.def(
      "viterbi",
      [](const Model& self, int class_index, const py::array& symbols) {
        std::vector<int> path;
        const double score = self.viterbi(class_index, as_integers(symbols, "symbols"), &path);
        return py::make_tuple(score, to_array(path));
      },
      py::arg("class_index"), py::arg("symbols"),
      "Log possibility of the best path and the path, int32.");
  cls.def(
      "transition",
      [](const Model& self, int class_index) { return to_array(self.transition(class_index)); },
      py::arg("class_index"));
  cls.def(
      "emission",
      [](const Model& self, int class_index) { return to_array(self.emission(class_index)); },
      py::arg("class_index"));
  cls.def_property_readonly("num_classes", &Model::num_classes);
  cls.def_property_readonly("num_symbols", &Model::num_symbols);
  cls.def_property_readonly("topology", &Model::topology);
  cls.def_property_readonly("conjunction", &Model::conjunction);
  bind_files(cls);
}

}  // namespace

void bind_sequence_models(py::module_& m) {
  bind_hmm(m);
  bind_possibilistic(m);
}
