// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Models of sequences: topologies, HMMs with Gaussian-mixture or discrete emissions, the
// possibility-theory HMM set.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "hri/models/discrete_hmm.hpp"
#include "hri/models/gaussian_mixture.hpp"
#include "hri/models/gaussian_mixture_hmm.hpp"
#include "hri/models/markov_chain.hpp"
#include "hri/models/possibilistic_hmm.hpp"
#include "hri/models/topology.hpp"
#include "model_inputs.hpp"
#include "options.hpp"

namespace py = pybind11;
using hri_bind::as_integers;
using hri_bind::as_matrix;
using hri_bind::as_vector;
using hri_bind::bind_files;
using hri_bind::DoubleArray;
using hri_bind::FloatArray;
using hri_bind::to_array;

namespace {

std::vector<hri::MatrixF> sequences_of(const std::vector<FloatArray>& arrays) {
  std::vector<hri::MatrixF> sequences;
  sequences.reserve(arrays.size());
  for (const FloatArray& a : arrays) sequences.emplace_back(as_matrix(a, "a sequence"));
  return sequences;
}

std::vector<hri::SymbolSequence> symbols_of(const std::vector<py::array>& arrays) {
  std::vector<hri::SymbolSequence> sequences;
  sequences.reserve(arrays.size());
  for (const py::array& a : arrays) sequences.push_back(as_integers(a, "a sequence"));
  return sequences;
}

void bind_topology(py::module_& m) {
  py::class_<hri::Topology> cls(m, "Topology", "Which transitions a sequence model has.");
  py::enum_<hri::Topology::Kind>(cls, "Kind")
      .value("left_right", hri::Topology::Kind::left_right)
      .value("banded", hri::Topology::Kind::banded)
      .value("ergodic", hri::Topology::Kind::ergodic)
      .value("rank_one_plus_band", hri::Topology::Kind::rank_one_plus_band);
  hri_bind::options(cls)
      .field("kind", &hri::Topology::kind)
      .field("num_states", &hri::Topology::num_states)
      .field("max_jump", &hri::Topology::max_jump);
  cls.def("allows", &hri::Topology::allows, py::arg("i"), py::arg("j"));
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
      .def_property_readonly("topology", &Chain::topology)
      .def_property_readonly("num_states", &Chain::num_states)
      .def_property_readonly("start", [](const Chain& self) { return to_array(self.start()); })
      .def_property_readonly("transition",
                             [](const Chain& self) { return to_array(self.transition()); })
      .def_property_readonly("band", [](const Chain& self) { return to_array(self.band()); })
      .def_property_readonly("leave", [](const Chain& self) { return to_array(self.leave()); })
      .def_property_readonly("land", [](const Chain& self) { return to_array(self.land()); });
  bind_files(chain);

  py::class_<hri::TrainingReport>(m, "TrainingReport", "How an iterative training went.")
      .def(py::init<>())
      .def_readonly("log_likelihoods", &hri::TrainingReport::log_likelihoods)
      .def_readonly("converged", &hri::TrainingReport::converged);
}

void bind_gaussian_mixture(py::module_& m) {
  py::class_<hri::GaussianMixtureOptions> options(m, "GaussianMixtureOptions",
                                                  "Options of GaussianMixture.");
  hri_bind::options(options)
      .field("num_mixtures", &hri::GaussianMixtureOptions::num_mixtures)
      .field("max_iterations", &hri::GaussianMixtureOptions::max_iterations)
      .field("tolerance", &hri::GaussianMixtureOptions::tolerance)
      .field("variance_floor", &hri::GaussianMixtureOptions::variance_floor)
      .field("wide_weight", &hri::GaussianMixtureOptions::wide_weight)
      .field("seed", &hri::GaussianMixtureOptions::seed);
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
  cls.def_property_readonly("dim", &hri::GaussianMixture::dim);
  cls.def_property_readonly(
      "weights", [](const hri::GaussianMixture& self) { return to_array(self.bank().weights()); });
  cls.def_property_readonly(
      "means", [](const hri::GaussianMixture& self) { return to_array(self.bank().means()); });
  cls.def_property_readonly("variances", [](const hri::GaussianMixture& self) {
    return to_array(self.bank().variances());
  });
  bind_files(cls);
}

void bind_gaussian_mixture_hmm(py::module_& m) {
  using Model = hri::GaussianMixtureHmm;
  using Options = hri::GaussianMixtureHmmOptions;
  py::class_<Options> options(m, "GaussianMixtureHmmOptions", "Options of GaussianMixtureHmm.");
  hri_bind::options(options)
      .field("topology", &Options::topology)
      .field("num_mixtures", &Options::num_mixtures)
      .field("max_iterations", &Options::max_iterations)
      .field("tolerance", &Options::tolerance)
      .field("variance_floor", &Options::variance_floor)
      .field("weight_floor", &Options::weight_floor)
      .field("seed", &Options::seed);
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
  cls.def_property_readonly("dim", &Model::dim);
  cls.def_property_readonly("weights",
                            [](const Model& self) { return to_array(self.bank().weights()); });
  cls.def_property_readonly("means",
                            [](const Model& self) { return to_array(self.bank().means()); });
  cls.def_property_readonly("variances",
                            [](const Model& self) { return to_array(self.bank().variances()); });
  cls.def_property_readonly("num_states", &Model::num_states);
  cls.def_property_readonly("chain", &Model::chain);
  bind_files(cls);
}

void bind_discrete_hmm(py::module_& m) {
  using Model = hri::DiscreteHmm;
  using Options = hri::DiscreteHmmOptions;
  py::class_<Options> options(m, "DiscreteHmmOptions", "Options of DiscreteHmm.");
  hri_bind::options(options)
      .field("topology", &Options::topology)
      .field("num_symbols", &Options::num_symbols)
      .field("max_iterations", &Options::max_iterations)
      .field("tolerance", &Options::tolerance)
      .field("emission_floor", &Options::emission_floor)
      .field("seed", &Options::seed);
  py::class_<Model> cls(m, "DiscreteHmm", "HMM over discrete symbols.");
  cls.def(py::init([](const hri::MarkovChain& chain, const DoubleArray& emission) {
            return Model(chain, as_matrix(emission, "emission"));
          }),
          py::arg("chain"), py::arg("emission"), "emission has shape (num_states, num_symbols).");
  cls.def_static(
      "train",
      [](const std::vector<py::array>& sequences, Options o, hri::TrainingReport* report) {
        const std::vector<hri::SymbolSequence> symbols = symbols_of(sequences);
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return Model::train(symbols, o, report);
      },
      py::arg("sequences"), py::arg("options"), py::arg("report") = nullptr);
  cls.def(
      "log_likelihood",
      [](const Model& self, const py::array& symbols) {
        return self.log_likelihood(as_integers(symbols, "symbols"));
      },
      py::arg("symbols"), "log P(symbols | model), natural log.");
  cls.def(
      "viterbi",
      [](const Model& self, const py::array& symbols) {
        std::vector<int> path;
        const double score = self.viterbi(as_integers(symbols, "symbols"), &path);
        return py::make_tuple(score, to_array(path));
      },
      py::arg("symbols"), "log P(symbols, best path | model) and the path, int32.");
  cls.def_property_readonly("num_symbols", &Model::num_symbols);
  cls.def_property_readonly("emission",
                            [](const Model& self) { return to_array(self.emission()); });
  cls.def_property_readonly("num_states", &Model::num_states);
  cls.def_property_readonly("chain", &Model::chain);
  bind_files(cls);
}

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
        for (const auto& sequences : per_class) symbols.push_back(symbols_of(sequences));
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
  bind_topology(m);
  bind_gaussian_mixture(m);
  bind_gaussian_mixture_hmm(m);
  bind_discrete_hmm(m);
  bind_possibilistic(m);
}
