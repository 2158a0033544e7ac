// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Possibility-theory HMMs: the set of all classes, its 16-bit form and its stream.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>

#include "core/options.hpp"
#include "hri/models/possibility/fixed_point_hmm.hpp"
#include "hri/models/possibility/possibilistic_gaussian_hmm.hpp"
#include "hri/models/possibility/possibilistic_hmm.hpp"
#include "hri/models/possibility/possibilistic_stream.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_integers;
using hri_bind::as_symbols;
using hri_bind::bind_files;
using hri_bind::to_array;

namespace {

using Set = hri::PossibilisticHmmSet;
using SetOptions = hri::PossibilisticHmmOptions;

template <class Model>
py::array_t<float> scores_of(const Model& self, const py::array& symbols) {
  const hri_bind::Integers s(symbols, "symbols");
  py::array_t<float> out(self.num_classes());
  const hri::Span<float> scores(out.mutable_data(), static_cast<std::size_t>(out.size()));
  {
    const py::gil_scoped_release release;
    self.log_possibilities(s.span(), scores);
  }
  return out;
}

constexpr const char* kStateDoc =
    "Possibility and necessity of each state at each frame under one class (thesis eq. 4.10-4.17 "
    "and 4.23). Raises InvalidArgument for a conditioned minimum unless concentration is 1.";

void bind_state_possibilities(py::module_& m) {
  using States = hri::StatePossibilities;
  py::class_<States> cls(m, "StatePossibilities",
                         "What one class of a set of possibility-theory HMMs says of its states, "
                         "frame by frame; float64, shape (num_frames, num_states).");
  cls.def_readonly("log_possibility", &States::log_possibility,
                   "Of the whole sequence (eq. 4.12), natural log; -inf for impossible.");
  const auto matrix = [&cls](const char* name, hri::MatrixD States::*member, const char* doc) {
    cls.def_property_readonly(
        name, [member](const States& self) { return to_array(self.*member); }, doc);
  };
  matrix("log_forward", &States::log_forward,
         "log of phi_t(i) (eq. 4.10-4.11), of the best path through frames 0..t that ends in i.");
  matrix(
      "log_backward", &States::log_backward,
      "log of gamma_t(i) (eq. 4.15-4.16), of the best way on from i through the frames after t.");
  matrix("possibility", &States::possibility,
         "Of state i at frame t given all frames (eq. 4.23), 0..1; 1 for the best state.");
  matrix("necessity", &States::necessity, "1 - the possibility of the best other state, 0..1.");
}

void bind_set(py::module_& m) {
  using Rule = hri::PossibilisticRule;
  hri_bind::bind_options<Rule>(m, "How a PossibilisticHmmSet is scored.");
  hri_bind::bind_options<SetOptions>(m, "Options of PossibilisticHmmSet.");
  py::class_<Set> cls(
      m, "PossibilisticHmmSet",
      "Possibility-theory HMMs of all classes, trained and scaled together (thesis chapter 4).");
  cls.def(py::init<std::vector<hri::DiscreteHmm>, Rule>(), py::arg("models"),
          py::arg_v("rule", Rule(), "PossibilisticRule()"),
          "The set of trained HMMs: starts, transitions and the emissions of each symbol divided "
          "by the largest over all classes and states (eq. 5.14).");
  cls.def_static(
      "train",
      [](const std::vector<std::vector<py::array>>& per_class, SetOptions o) {
        std::vector<std::vector<hri::SymbolSequence>> symbols;
        symbols.reserve(per_class.size());
        for (const auto& sequences : per_class) symbols.push_back(as_symbols(sequences));
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return Set::train(symbols, o);
      },
      py::arg("per_class"), py::arg("options"),
      "per_class[c] lists the symbol sequences of class c.");
  cls.def("with_class", py::overload_cast<hri::DiscreteHmm>(&Set::with_class, py::const_),
          py::arg("model"),
          "The set with one class more, which comes last; no other class is trained again.");
  cls.def(
      "with_class",
      [](const Set& self, const std::vector<py::array>& sequences, SetOptions o) {
        const std::vector<hri::SymbolSequence> symbols = as_symbols(sequences);
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return self.with_class(symbols, o);
      },
      py::arg("sequences"), py::arg("options"));
  cls.def("log_possibilities", &scores_of<Set>, py::arg("symbols"),
          "log possibility of the symbols under each class, float32, shape (num_classes,).");
  cls.def(
      "log_possibilities_exact",
      [](const Set& self, const py::array& symbols) {
        const hri::SymbolSequence s = as_integers(symbols, "symbols");
        hri::VectorD scores;
        {
          const py::gil_scoped_release release;
          scores = self.log_possibilities_exact(s);
        }
        return to_array(scores);
      },
      py::arg("symbols"), "The same computed in float64.");
  cls.def(
      "classify",
      [](const Set& self, const py::array& symbols) {
        const hri::SymbolSequence s = as_integers(symbols, "symbols");
        hri::Possibilities p;
        {
          const py::gil_scoped_release release;
          p = self.classify(s);
        }
        return py::make_tuple(to_array(p.possibility), to_array(p.necessity));
      },
      py::arg("symbols"),
      "Possibility and necessity of each class, two float32 arrays of shape (num_classes,).");
  cls.def(
      "viterbi",
      [](const Set& self, int class_index, const py::array& symbols) {
        const hri::SymbolSequence s = as_integers(symbols, "symbols");
        std::vector<int> path;
        double score = 0;
        {
          const py::gil_scoped_release release;
          score = self.viterbi(class_index, s, &path);
        }
        return py::make_tuple(score, to_array(path));
      },
      py::arg("class_index"), py::arg("symbols"),
      "Log possibility of the best path and the path, int32.");
  cls.def(
      "state_possibilities",
      [](const Set& self, int class_index, const py::array& symbols) {
        const hri::SymbolSequence s = as_integers(symbols, "symbols");
        const py::gil_scoped_release release;
        return self.state_possibilities(class_index, s);
      },
      py::arg("class_index"), py::arg("symbols"), kStateDoc);
  const auto matrix = [&cls](const char* name, auto method, const char* doc) {
    cls.def(
        name, [method](const Set& self, int c) { return to_array((self.*method)(c)); },
        py::arg("class_index"), doc);
  };
  matrix("start", &Set::start, "Possibilities, shape (num_states,).");
  matrix("transition", &Set::transition, "Possibilities, shape (num_states, num_states).");
  matrix("emission", &Set::emission, "Possibilities, shape (num_states, num_symbols).");
  cls.def_property_readonly("models", &Set::models, "The HMMs before scaling.");
  cls.def_property_readonly("num_classes", &Set::num_classes, "Number of classes.");
  cls.def_property_readonly("num_states", &Set::num_states, "States of each model.");
  cls.def_property_readonly("num_symbols", &Set::num_symbols, "Size of the alphabet.");
  cls.def_property_readonly("topology", &Set::topology, "Which transitions there are, a Topology.");
  cls.def_property_readonly("rule", &Set::rule,
                            "How possibilities are combined, a PossibilisticRule.");
  bind_files(cls);
}

void bind_gaussian_set(py::module_& m) {
  using Model = hri::PossibilisticGaussianHmmSet;
  using hri_bind::as_matrix;
  using hri_bind::FloatArray;
  py::class_<Model> cls(m, "PossibilisticGaussianHmmSet",
                        "Possibility-theory HMMs over frames, emissions Gaussian mixtures.");
  cls.def(py::init<std::vector<hri::GaussianMixtureHmm>, hri::PossibilisticRule>(),
          py::arg("models"), py::arg_v("rule", hri::PossibilisticRule(), "PossibilisticRule()"));
  cls.def_static(
      "train",
      [](const std::vector<std::vector<FloatArray>>& per_class, hri::GaussianMixtureHmmOptions o,
         const hri::PossibilisticRule& rule) {
        std::vector<std::vector<hri::MatrixF>> frames(per_class.size());
        for (std::size_t c = 0; c < per_class.size(); ++c) {
          for (const FloatArray& a : per_class[c])
            frames[c].emplace_back(as_matrix(a, "a sequence"));
        }
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return Model::train(frames, o, rule);
      },
      py::arg("per_class"), py::arg("options"),
      py::arg_v("rule", hri::PossibilisticRule(), "PossibilisticRule()"),
      "per_class[c] lists the (num_frames, dim) arrays of class c.");
  cls.def("with_class", &Model::with_class, py::arg("model"),
          "The set with one class more, which comes last; no other class is trained again.");
  cls.def(
      "log_possibilities",
      [](const Model& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        py::array_t<float> out(self.num_classes());
        const hri::Span<float> scores(out.mutable_data(), static_cast<std::size_t>(out.size()));
        {
          const py::gil_scoped_release release;
          self.log_possibilities(matrix, scores);
        }
        return out;
      },
      py::arg("frames"),
      "log possibility of the frames under each class, float32, shape (num_classes,).");
  cls.def(
      "classify",
      [](const Model& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        hri::Possibilities p;
        {
          const py::gil_scoped_release release;
          p = self.classify(matrix);
        }
        return py::make_tuple(to_array(p.possibility), to_array(p.necessity));
      },
      py::arg("frames"),
      "Possibility and necessity of each class, two float32 arrays of shape (num_classes,).");
  cls.def(
      "viterbi",
      [](const Model& self, int class_index, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        std::vector<int> path;
        double score = 0;
        {
          const py::gil_scoped_release release;
          score = self.viterbi(class_index, matrix, &path);
        }
        return py::make_tuple(score, to_array(path));
      },
      py::arg("class_index"), py::arg("frames"),
      "Log possibility of the best path and the path, int32.");
  cls.def(
      "state_possibilities",
      [](const Model& self, int class_index, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        const py::gil_scoped_release release;
        return self.state_possibilities(class_index, matrix);
      },
      py::arg("class_index"), py::arg("frames"), kStateDoc);
  cls.def_property_readonly("models", &Model::models, "The HMMs before scaling.");
  cls.def_property_readonly("num_classes", &Model::num_classes, "Number of classes.");
  cls.def_property_readonly("dim", &Model::dim, "Columns of the rows it takes.");
  cls.def_property_readonly("topology", &Model::topology,
                            "Which transitions there are, a Topology.");
  cls.def_property_readonly("rule", &Model::rule,
                            "How possibilities are combined, a PossibilisticRule.");
  bind_files(cls);
}

void bind_fixed_point(py::module_& m) {
  using Model = hri::FixedPointHmmSet;
  py::class_<Model>(m, "FixedPointHmmSet",
                    "The product recursion of a PossibilisticHmmSet in 16-bit integers.")
      .def(py::init<const Set&>(), py::arg("set"))
      .def("log_possibilities", &scores_of<Model>, py::arg("symbols"),
           "log possibility of the symbols under each class, float32, shape (num_classes,).")
      .def_property_readonly("num_classes", &Model::num_classes, "Number of classes.")
      .def_property_readonly("num_symbols", &Model::num_symbols, "Size of the alphabet.")
      .def_property_readonly("units", &Model::units, "Integer steps in one natural-log unit.");
}

void bind_possibility_stream(py::module_& m) {
  using Stream = hri::PossibilisticHmmStream;
  py::class_<Stream>(m, "PossibilisticHmmStream",
                     "Scores of a PossibilisticHmmSet while the symbols come in.")
      .def(py::init([](const Set& set, double beam) {
             hri::HmmStreamOptions options;
             options.beam = beam;
             return Stream(set, options);
           }),
           py::arg("set"), py::arg("beam") = std::numeric_limits<double>::infinity(),
           "Classes that fall by more than `beam` (natural log) below the best are dropped.")
      .def("push", &Stream::push, py::arg("symbol"), "Score the next symbol under every class.")
      .def(
          "log_possibilities",
          [](const Stream& self) {
            py::array_t<float> out(self.num_classes());
            self.log_possibilities({out.mutable_data(), static_cast<std::size_t>(out.size())});
            return out;
          },
          "Of all symbols so far under each class, float32, shape (num_classes,).")
      .def("nbest", &Stream::nbest, py::arg("count") = 5,
           "Indices of the best classes, best first.")
      .def("reset", &Stream::reset, "Ready for the next utterance.")
      .def_property_readonly("num_classes", &Stream::num_classes, "Number of classes.")
      .def_property_readonly("num_frames", &Stream::num_frames, "Frames pushed so far.")
      .def_property_readonly("num_active", &Stream::num_active, "Classes not dropped.");
}

}  // namespace

void bind_possibilistic(py::module_& m) {
  bind_state_possibilities(m);
  bind_set(m);
  bind_gaussian_set(m);
  bind_fixed_point(m);
  bind_possibility_stream(m);
}
