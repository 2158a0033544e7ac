// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Hidden Markov models: topologies, chains, Gaussian-mixture and discrete emissions.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>

#include "core/options.hpp"
#include "hri/models/hmm/discrete_hmm.hpp"
#include "hri/models/hmm/gaussian_mixture.hpp"
#include "hri/models/hmm/gaussian_mixture_hmm.hpp"
#include "hri/models/hmm/markov_chain.hpp"
#include "hri/models/hmm/sampling.hpp"
#include "hri/models/hmm/topology.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_integers;
using hri_bind::as_matrix;
using hri_bind::as_symbols;
using hri_bind::as_vector;
using hri_bind::bind_files;
using hri_bind::DoubleArray;
using hri_bind::FloatArray;
using hri_bind::Integers;
using hri_bind::to_array;

namespace {

std::vector<hri::MatrixF> sequences_of(const std::vector<FloatArray>& arrays) {
  std::vector<hri::MatrixF> sequences;
  sequences.reserve(arrays.size());
  for (const FloatArray& a : arrays) sequences.emplace_back(as_matrix(a, "a sequence"));
  return sequences;
}

void bind_topology(py::module_& m) {
  auto cls = hri_bind::bind_options<hri::Topology>(m, "Which transitions a sequence model has.");
  cls.def("allows", &hri::Topology::allows, py::arg("i"), py::arg("j"),
          "Whether there is a transition from state i to j.");
  m.def(
      "initial_start",
      [](const hri::Topology& topology) {
        hri::validate(topology);
        return to_array(hri::initial_start(topology));
      },
      py::arg("topology"), "Start probabilities, shape (num_states,).");
  m.def(
      "initial_transition",
      [](const hri::Topology& topology, double stay) {
        hri::validate(topology);
        return to_array(hri::initial_transition(topology, stay));
      },
      py::arg("topology"), py::arg("stay") = 0.6,
      "Row-stochastic start values without jumps, shape (num_states, num_states).");

  using Chain = hri::MarkovChain;
  py::class_<Chain> chain(m, "MarkovChain",
                          "Start and transition probabilities of a sequence model.");
  chain
      .def(py::init([](const hri::Topology& topology, const DoubleArray& start,
                       const DoubleArray& transition) {
             return Chain(topology, as_vector(start, "start"), as_matrix(transition, "transition"));
           }),
           py::arg("topology"), py::arg("start"), py::arg("transition"))
      .def(py::init([](const hri::Topology& topology, const DoubleArray& start,
                       const DoubleArray& band, const DoubleArray& leave, const DoubleArray& land) {
             return Chain(topology, as_vector(start, "start"), as_matrix(band, "band"),
                          as_vector(leave, "leave"), as_vector(land, "land"));
           }),
           py::arg("topology"), py::arg("start"), py::arg("band"), py::arg("leave"),
           py::arg("land"), "rank_one_plus_band: a_ij = band[i, j] + leave[i] * land[j].")
      .def_static("initial", &Chain::initial, py::arg("topology"))
      .def_property_readonly("topology", &Chain::topology,
                             "Which transitions there are, a Topology.")
      .def_property_readonly("num_states", &Chain::num_states, "States of each model.")
      .def_property_readonly(
          "start", [](const Chain& self) { return to_array(self.start()); },
          "Initial probabilities, shape (num_states,).")
      .def_property_readonly(
          "transition", [](const Chain& self) { return to_array(self.transition()); },
          "Transition probabilities, shape (num_states, num_states), row i from state i.")
      .def_property_readonly(
          "band", [](const Chain& self) { return to_array(self.band()); },
          "Transition probabilities within the band, a row for each state.")
      .def_property_readonly(
          "leave", [](const Chain& self) { return to_array(self.leave()); },
          "Weight of a jump from each state; rank-one part.")
      .def_property_readonly(
          "land", [](const Chain& self) { return to_array(self.land()); },
          "Weight of a jump to each state; rank-one part.");
  bind_files(chain);

  py::class_<hri::TrainingReport>(m, "TrainingReport", "How an iterative training went.")
      .def(py::init<>())
      .def_readonly("log_likelihoods", &hri::TrainingReport::log_likelihoods,
                    "Before each iteration.")
      .def_readonly("converged", &hri::TrainingReport::converged,
                    "The change fell below the tolerance.");
}

void bind_gaussian_mixture(py::module_& m) {
  hri_bind::bind_options<hri::GaussianMixtureOptions>(m, "Options of GaussianMixture.");
  py::class_<hri::GaussianMixture> cls(m, "GaussianMixture",
                                       "Gaussian mixture with diagonal covariance.");
  cls.def_static(
      "train",
      [](const FloatArray& rows, hri::GaussianMixtureOptions o, hri::TrainingReport* report) {
        const auto matrix = as_matrix(rows, "rows");
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return hri::GaussianMixture::train(matrix, o, report);
      },
      py::arg("rows"),
      py::arg_v("options", hri::GaussianMixtureOptions(), "GaussianMixtureOptions()"),
      py::arg("report") = nullptr);
  cls.def(
      "log_likelihood",
      [](const hri::GaussianMixture& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        const py::gil_scoped_release release;
        return self.log_likelihood(matrix);
      },
      py::arg("frames"), "Sum over the frames of log p(frame), natural log.");
  cls.def_property_readonly("dim", &hri::GaussianMixture::dim, "Columns of the rows it takes.");
  cls.def_property_readonly(
      "weights", [](const hri::GaussianMixture& self) { return to_array(self.bank().weights()); },
      "Mixture weights.");
  cls.def_property_readonly(
      "means", [](const hri::GaussianMixture& self) { return to_array(self.bank().means()); },
      "Means of the mixture components, a row each.");
  cls.def_property_readonly(
      "variances",
      [](const hri::GaussianMixture& self) { return to_array(self.bank().variances()); },
      "Variances of the mixture components, a row each.");
  bind_files(cls);
}

void bind_forward_backward(py::module_& m) {
  using Both = hri::ForwardBackward;
  py::class_<Both>(m, "ForwardBackward",
                   "Forward and backward log probabilities of an HMM's states, natural logs.")
      .def_readonly("log_likelihood", &Both::log_likelihood,
                    "log P(frames | model); -inf for an impossible sequence.")
      .def_property_readonly(
          "log_forward", [](const Both& self) { return to_array(self.log_forward); },
          "log P(frames 0..t, state of t), float64, shape (num_frames, num_states).")
      .def_property_readonly(
          "log_backward", [](const Both& self) { return to_array(self.log_backward); },
          "log P(frames after t | state of t), float64, shape (num_frames, num_states).");
}

// Both kinds of HMM; `convert` takes the argument of the caller to what the model scores.
template <class Model, class Array, class Convert>
void bind_states(py::class_<Model>& cls, const char* argument, const Convert& convert) {
  cls.def(
      "posterior",
      [convert](const Model& self, const Array& array) {
        const auto values = convert(array);
        hri::MatrixD gamma;
        {
          const py::gil_scoped_release release;
          gamma = self.posterior(values);
        }
        return to_array(gamma);
      },
      py::arg(argument),
      "P(state | all of the sequence), shape (num_frames, num_states). Raises InvalidArgument "
      "where "
      "the sequence is impossible.");
  cls.def(
      "state_posteriors",
      [convert](const Model& self, const Array& array) {
        const auto values = convert(array);
        hri::MatrixD gamma;
        double log_likelihood = 0;
        {
          const py::gil_scoped_release release;
          log_likelihood = self.state_posteriors(values, &gamma);
        }
        return py::make_tuple(log_likelihood, to_array(gamma));
      },
      py::arg(argument),
      "Log-likelihood of the sequence, and posterior() of it, all 0 where it is impossible.");
  cls.def(
      "forward_backward",
      [convert](const Model& self, const Array& array) {
        const auto values = convert(array);
        const py::gil_scoped_release release;
        return self.forward_backward(values);
      },
      py::arg(argument), "Forward and backward log probabilities of the states, frame by frame.");
}

void bind_gaussian_mixture_hmm(py::module_& m) {
  using Model = hri::GaussianMixtureHmm;
  using Options = hri::GaussianMixtureHmmOptions;
  hri_bind::bind_options<Options>(m, "Options of GaussianMixtureHmm.");
  py::class_<Model> cls(m, "GaussianMixtureHmm",
                        "HMM with Gaussian-mixture emissions of diagonal covariance.");
  cls.def(py::init([](const hri::MarkovChain& chain, const DoubleArray& weights,
                      const DoubleArray& means, const DoubleArray& variances) {
            return Model(chain,
                         hri::MixtureBank(as_matrix(weights, "weights"), as_matrix(means, "means"),
                                          as_matrix(variances, "variances")));
          }),
          py::arg("chain"), py::arg("weights"), py::arg("means"), py::arg("variances"),
          "weights (num_states, num_mixtures); means and variances (num_states * num_mixtures, "
          "dim), state by state.");
  cls.def_static(
      "train",
      [](const std::vector<FloatArray>& sequences, Options o, hri::TrainingReport* report) {
        const std::vector<hri::MatrixF> frames = sequences_of(sequences);
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return Model::train(frames, o, report);
      },
      py::arg("sequences"), py::arg_v("options", Options(), "GaussianMixtureHmmOptions()"),
      py::arg("report") = nullptr, "Baum-Welch over a list of (num_frames, dim) arrays.");
  cls.def(
      "retrain",
      [](const Model& self, const std::vector<FloatArray>& sequences, Options o,
         hri::TrainingReport* report) {
        const std::vector<hri::MatrixF> frames = sequences_of(sequences);
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return self.retrain(frames, o, report);
      },
      py::arg("sequences"), py::arg_v("options", Options(), "GaussianMixtureHmmOptions()"),
      py::arg("report") = nullptr,
      "A model trained further; topology, num_mixtures and seed of the options are not read.");
  const auto scorer = [](double (Model::*method)(hri::ConstMatrixRefF) const) {
    return [method](const Model& self, const FloatArray& frames) {
      const auto matrix = as_matrix(frames, "frames");
      const py::gil_scoped_release release;
      return (self.*method)(matrix);
    };
  };
  cls.def("log_likelihood", scorer(&Model::log_likelihood), py::arg("frames"),
          "log P(frames | model), natural log; emissions in float.");
  cls.def("log_likelihood_exact", scorer(&Model::log_likelihood_exact), py::arg("frames"),
          "The same with emissions in double.");
  cls.def(
      "viterbi",
      [](const Model& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        std::vector<int> path;
        double score = 0;
        {
          const py::gil_scoped_release release;
          score = self.viterbi(matrix, &path);
        }
        return py::make_tuple(score, to_array(path));
      },
      py::arg("frames"), "log P(frames, best path | model) and the path, int32.");
  bind_states<Model, FloatArray>(
      cls, "frames", [](const FloatArray& frames) { return as_matrix(frames, "frames"); });
  cls.def(
      "sample",
      [](const Model& self, int count, std::uint64_t seed) {
        const hri::SampledFrames drawn = hri::sample(self, count, seed);
        return py::make_tuple(to_array(drawn.frames), to_array(drawn.states));
      },
      py::arg("count"), py::arg("seed"), "Frames drawn from the model, and their states.");
  cls.def_property_readonly("dim", &Model::dim, "Columns of the rows it takes.");
  cls.def_property_readonly(
      "weights", [](const Model& self) { return to_array(self.bank().weights()); },
      "Mixture weights, a row for each state.");
  cls.def_property_readonly(
      "means", [](const Model& self) { return to_array(self.bank().means()); },
      "Means of the mixture components, a row each.");
  cls.def_property_readonly(
      "variances", [](const Model& self) { return to_array(self.bank().variances()); },
      "Variances of the mixture components, a row each.");
  cls.def_property_readonly("num_states", &Model::num_states, "States of each model.");
  cls.def_property_readonly("chain", &Model::chain,
                            "Initial and transition probabilities, a MarkovChain.");
  bind_files(cls);
}

void bind_discrete_hmm(py::module_& m) {
  using Model = hri::DiscreteHmm;
  using Options = hri::DiscreteHmmOptions;
  hri_bind::bind_options<Options>(m, "Options of DiscreteHmm.");
  py::class_<Model> cls(m, "DiscreteHmm", "HMM over discrete symbols.");
  cls.def(py::init([](const hri::MarkovChain& chain, const DoubleArray& emission) {
            return Model(chain, as_matrix(emission, "emission"));
          }),
          py::arg("chain"), py::arg("emission"), "emission has shape (num_states, num_symbols).");
  cls.def_static(
      "train",
      [](const std::vector<py::array>& sequences, Options o, hri::TrainingReport* report) {
        const std::vector<hri::SymbolSequence> symbols = as_symbols(sequences);
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return Model::train(symbols, o, report);
      },
      py::arg("sequences"), py::arg("options"), py::arg("report") = nullptr,
      "Baum-Welch over a list of integer arrays.");
  cls.def(
      "retrain",
      [](const Model& self, const std::vector<py::array>& sequences, Options o,
         hri::TrainingReport* report) {
        const std::vector<hri::SymbolSequence> symbols = as_symbols(sequences);
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return self.retrain(symbols, o, report);
      },
      py::arg("sequences"), py::arg("options"), py::arg("report") = nullptr,
      "A model trained further; topology, num_symbols and seed of the options are not read.");
  const auto scorer = [](double (Model::*method)(hri::Span<const std::int32_t>) const) {
    return [method](const Model& self, const py::array& array) {
      const Integers symbols(array, "symbols");
      // A short word is scored in less time than it takes to let other threads run.
      std::optional<py::gil_scoped_release> release;
      if (symbols.span().size() > 256) release.emplace();
      return (self.*method)(symbols.span());
    };
  };
  cls.def("log_likelihood", scorer(&Model::log_likelihood), py::arg("symbols"),
          "log P(symbols | model), natural log.");
  cls.def("log_likelihood_exact", scorer(&Model::log_likelihood_exact), py::arg("symbols"),
          "The same in logs from the first symbol on: slow, to compare with.");
  cls.def(
      "viterbi",
      [](const Model& self, const py::array& array) {
        const Integers symbols(array, "symbols");
        std::vector<int> path;
        double score = 0;
        {
          const py::gil_scoped_release release;
          score = self.viterbi(symbols.span(), &path);
        }
        return py::make_tuple(score, to_array(path));
      },
      py::arg("symbols"), "log P(symbols, best path | model) and the path, int32.");
  bind_states<Model, py::array>(
      cls, "symbols", [](const py::array& array) { return as_integers(array, "symbols"); });
  cls.def(
      "sample",
      [](const Model& self, int count, std::uint64_t seed) {
        const hri::SampledSymbols drawn = hri::sample(self, count, seed);
        return py::make_tuple(to_array(drawn.symbols), to_array(drawn.states));
      },
      py::arg("count"), py::arg("seed"), "Symbols drawn from the model, and their states.");
  cls.def_property_readonly("num_symbols", &Model::num_symbols, "Size of the alphabet.");
  cls.def_property_readonly(
      "emission", [](const Model& self) { return to_array(self.emission()); },
      "Probabilities of symbols, shape (num_states, num_symbols).");
  cls.def_property_readonly("num_states", &Model::num_states, "States of each model.");
  cls.def_property_readonly("chain", &Model::chain,
                            "Initial and transition probabilities, a MarkovChain.");
  bind_files(cls);
}

}  // namespace

void bind_hmm_tools(py::module_& m);

void bind_hmm(py::module_& m) {
  bind_topology(m);
  bind_gaussian_mixture(m);
  bind_forward_backward(m);
  bind_gaussian_mixture_hmm(m);
  bind_discrete_hmm(m);
  bind_hmm_tools(m);
}
