// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// What works on whole HMMs: streams of scores, and the choice of the number of states.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>
#include <string>

#include "core/options.hpp"
#include "hri/models/hmm/hmm_stream.hpp"
#include "hri/models/hmm/model_selection.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_matrix;
using hri_bind::as_symbols;
using hri_bind::FloatArray;
using hri_bind::Integers;
using hri_bind::to_array;

namespace {

template <class Stream, class Model>
py::class_<Stream> bind_stream(py::module_& m, const char* name, const char* doc) {
  py::class_<Stream> cls(m, name, doc);
  cls.def(py::init([](const std::vector<Model>& models, double beam) {
            hri::HmmStreamOptions options;
            options.beam = beam;
            return Stream(models, options);
          }),
          py::arg("models"), py::arg_v("beam", std::numeric_limits<double>::infinity(), "inf"),
          "Models whose log-likelihood falls `beam` below the best are dropped until reset().");
  cls.def(
      "log_likelihoods",
      [](const Stream& self) {
        hri::VectorD scores(self.num_models());
        self.log_likelihoods({scores.data(), static_cast<std::size_t>(scores.size())});
        return to_array(scores);
      },
      "log P(frames so far | model) of every model; -inf for those dropped or impossible.");
  cls.def("nbest", &Stream::nbest, py::arg("count"),
          "Indices of the best models, best first, without those at -inf.");
  cls.def("reset", &Stream::reset, "Back to before the first frame, with all models.");
  cls.def_property_readonly("num_models", &Stream::num_models, "Models that are scored.");
  cls.def_property_readonly("num_active", &Stream::num_active, "Models not dropped.");
  cls.def_property_readonly("num_frames", &Stream::num_frames, "Frames pushed so far.");
  return cls;
}

void bind_hmm_streams(py::module_& m) {
  bind_stream<hri::DiscreteHmmStream, hri::DiscreteHmm>(
      m, "DiscreteHmmStream", "Scores of several DiscreteHmm while the symbols still arrive.")
      .def("push", &hri::DiscreteHmmStream::push, py::arg("symbol"),
           "Advances all models by one symbol.")
      .def(
          "push_all",
          [](hri::DiscreteHmmStream& self, const py::array& array) {
            const Integers symbols(array, "symbols");
            for (const std::int32_t symbol : symbols.span()) self.push(symbol);
          },
          py::arg("symbols"), "push() of every symbol.");
  bind_stream<hri::GaussianMixtureHmmStream, hri::GaussianMixtureHmm>(
      m, "GaussianMixtureHmmStream",
      "Scores of several GaussianMixtureHmm while the frames still arrive.")
      .def(
          "push",
          [](hri::GaussianMixtureHmmStream& self, const FloatArray& frame) {
            self.push(hri_bind::as_span(frame, "frame"));
          },
          py::arg("frame"), "Advances all models by one frame, shape (dim,).")
      .def(
          "push_all",
          [](hri::GaussianMixtureHmmStream& self, const FloatArray& frames) {
            const auto matrix = as_matrix(frames, "frames");
            for (Eigen::Index t = 0; t < matrix.rows(); ++t) self.push(hri::row_span(matrix, t));
          },
          py::arg("frames"), "push() of every row.");
}

void bind_state_choice(py::module_& m) {
  using Options = hri::StateChoiceOptions;
  hri_bind::bind_options<Options>(m, "Options of choose_num_states.");
  using Candidate = hri::StateChoice::Candidate;
  py::class_<hri::StateChoice> choice(m, "StateChoice", "What choose_num_states found.");
  py::class_<Candidate>(choice, "Candidate", "One number of states.")
      .def_readonly("num_states", &Candidate::num_states, "States of this candidate.")
      .def_readonly("score", &Candidate::score, "The larger, the better.")
      .def_readonly("log_likelihood", &Candidate::log_likelihood,
                    "Of the sequences it was judged on.")
      .def_readonly("num_parameters", &Candidate::num_parameters, "Free parameters of the model.");
  choice.def_readonly("num_states", &hri::StateChoice::num_states, "Of the best candidate.")
      .def_readonly("candidates", &hri::StateChoice::candidates, "In the order they were given.");
  constexpr const char* kDoc =
      "The number of states, out of `candidates`, whose models explain the sequences best: by BIC, "
      "or by the likelihood of sequences held out of training.";
  m.def(
      "choose_num_states",
      [](const std::vector<py::array>& sequences, hri::DiscreteHmmOptions o,
         const std::vector<int>& candidates, const Options& how) {
        const std::vector<hri::SymbolSequence> symbols = as_symbols(sequences);
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return hri::choose_num_states(symbols, o, candidates, how);
      },
      py::arg("sequences"), py::arg("options"), py::arg("candidates"),
      py::arg_v("choice", Options(), "StateChoiceOptions()"), kDoc);
  m.def(
      "choose_num_states",
      [](const std::vector<FloatArray>& sequences, hri::GaussianMixtureHmmOptions o,
         const std::vector<int>& candidates, const Options& how) {
        std::vector<hri::MatrixF> frames;
        frames.reserve(sequences.size());
        for (const FloatArray& a : sequences) frames.emplace_back(as_matrix(a, "a sequence"));
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return hri::choose_num_states(frames, o, candidates, how);
      },
      py::arg("sequences"), py::arg("options"), py::arg("candidates"),
      py::arg_v("choice", Options(), "StateChoiceOptions()"), kDoc);
}

}  // namespace

void bind_hmm_tools(py::module_& m) {
  bind_hmm_streams(m);
  bind_state_choice(m);
}
