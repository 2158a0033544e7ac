// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Language models, word networks and the decoder of connected words.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"
#include "hri/language/connected_decoder.hpp"
#include "hri/language/grammar.hpp"
#include "hri/language/lattice.hpp"
#include "hri/language/ngram_model.hpp"
#include "hri/language/word_emissions.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_matrix;
using hri_bind::as_span;
using hri_bind::DoubleArray;
using hri_bind::FloatArray;
using hri_bind::to_array;

namespace {

void bind_ngram_model(py::module_& m) {
  hri_bind::bind_options<hri::NGramOptions>(m, "Options of NGramModel.");
  py::class_<hri::NGramFit>(m, "NGramFit", "How well a language model predicts sentences.")
      .def_readonly("log_probability", &hri::NGramFit::log_probability,
                    "Natural log, of all words that the model knows.")
      .def_readonly("num_words", &hri::NGramFit::num_words,
                    "Predicted: known words and ends of sentences.")
      .def_readonly("num_unknown", &hri::NGramFit::num_unknown, "Words the model does not know.")
      .def_property_readonly("perplexity", &hri::NGramFit::perplexity,
                             "exp(-log_probability / num_words).");
  py::class_<hri::NGramModel>(
      m, "NGramModel", "N-gram language model of words with back-off; <s> and </s> are words, too.")
      .def_static("train", &hri::NGramModel::train, py::arg("sentences"),
                  py::arg_v("options", hri::NGramOptions(), "NGramOptions()"),
                  py::arg("vocabulary") = std::vector<std::string>{},
                  py::call_guard<py::gil_scoped_release>(),
                  "Trains on lists of words; `vocabulary` names words beside those in them. Raises "
                  "InvalidArgument for a word that is empty, a marker or has white space in it.")
      .def_static(
          "load", [](const hri_bind::Path& path) { return hri::NGramModel::load(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>(),
          "Reads an ARPA file; raises FormatError naming file and line.")
      .def_static("parse", &hri::NGramModel::parse, py::arg("text"), py::arg("name"),
                  py::call_guard<py::gil_scoped_release>(),
                  "Reads the text of an ARPA file; `name` is what errors call it.")
      .def(
          "save",
          [](const hri::NGramModel& self, const hri_bind::Path& path) { self.save(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>(), "Writes an ARPA file.")
      .def("to_arpa", &hri::NGramModel::to_arpa, "The text of the ARPA file.")
      .def("num_ngrams", &hri::NGramModel::num_ngrams, py::arg("order"),
           "How many n-grams of an order there are.")
      .def(
          "log_probability",
          [](const hri::NGramModel& self, const std::vector<std::string>& history,
             const std::string& word) {
            std::vector<int> numbers;
            numbers.reserve(history.size());
            for (const std::string& h : history) numbers.push_back(self.index_of(h));
            return self.log_probability(numbers, self.index_of(word));
          },
          py::arg("history"), py::arg("word"),
          "log P(word | history), natural log; -inf for an unknown word, unless there is <unk>.")
      .def("fit_of", &hri::NGramModel::fit_of, py::arg("sentences"),
           py::call_guard<py::gil_scoped_release>(), "An NGramFit: perplexity and what it is of.")
      .def_property_readonly("order", &hri::NGramModel::order, "Words of the longest n-grams.")
      .def_property_readonly("words", &hri::NGramModel::words, "All words and markers.");
}

void bind_network(py::module_& m) {
  py::class_<hri::WordNetwork>(m, "WordNetwork",
                               "Which words may follow which; nodes are words or null nodes.")
      .def(py::init([](std::vector<int> models,
                       const std::vector<std::tuple<int, int, double>>& arcs, int initial,
                       int final) {
             std::vector<hri::WordNetwork::Arc> made;
             made.reserve(arcs.size());
             for (const auto& [from, to, log_weight] : arcs) made.push_back({from, to, log_weight});
             return hri::WordNetwork(std::move(models), std::move(made), initial, final);
           }),
           py::arg("models"), py::arg("arcs"), py::arg("initial"), py::arg("final"),
           "`models[n]` is the model of node n, -1 for a null node; an arc is (from, to, log "
           "weight).")
      .def_static("loop", py::overload_cast<int, int>(&hri::WordNetwork::loop),
                  py::arg("num_words"), py::arg("silence") = -1,
                  "Any number of words in any order; `silence` is the model between them.")
      .def_static("sequence", &hri::WordNetwork::sequence, py::arg("num_words"), py::arg("length"),
                  py::arg("silence") = -1, "So many words in any order.")
      .def_static("transcript", &hri::WordNetwork::transcript, py::arg("words"),
                  py::arg("silence") = -1, "The given words in this order: for forced alignment.")
      .def_static("bigram", &hri::WordNetwork::bigram, py::arg("language"), py::arg("labels"),
                  py::arg("silence") = -1,
                  "Any number of words, weighted by a language model of order 1 or 2.")
      .def_property_readonly("models", &hri::WordNetwork::models,
                             "The model of every node; -1: a null node.")
      .def_property_readonly("initial", &hri::WordNetwork::initial, "Where sentences begin.")
      .def_property_readonly("final", &hri::WordNetwork::final, "Where they end.");
}

void bind_decoder(py::module_& m) {
  hri_bind::bind_options<hri::ConnectedDecoderOptions>(m, "Options of ConnectedDecoder.");
  py::class_<hri::WordChain>(m, "WordChain", "The states of a word as a decoder passes them.")
      .def(py::init([](const DoubleArray& log_start, const DoubleArray& log_transition,
                       const DoubleArray& log_exit, bool is_silence) {
             const auto vector = [](const DoubleArray& a, const char* name) {
               const auto span = as_span(a, name);
               return hri::VectorD(Eigen::Map<const hri::VectorD>(
                   span.data(), static_cast<Eigen::Index>(span.size())));
             };
             return hri::WordChain{vector(log_start, "log_start"),
                                   as_matrix(log_transition, "log_transition"),
                                   vector(log_exit, "log_exit"), is_silence};
           }),
           py::arg("log_start"), py::arg("log_transition"), py::arg("log_exit"),
           py::arg("is_silence") = false)
      .def_static("of", &hri::WordChain::of, py::arg("chain"), py::arg("final_stay"),
                  py::arg("is_silence") = false,
                  "Of a left-right MarkovChain, whose last state is left with 1 - final_stay.");
  py::class_<hri::DecodedWord>(m, "DecodedWord", "One word, or silence, of a decoded sentence.")
      .def_readonly("model", &hri::DecodedWord::model, "Number of the model.")
      .def_readonly("first_frame", &hri::DecodedWord::first_frame, "First frame.")
      .def_readonly("last_frame", &hri::DecodedWord::last_frame, "One past the last frame.")
      .def_readonly("log_score", &hri::DecodedWord::log_score, "What it adds to the sentence's.");
  py::class_<hri::DecodedSentence>(m, "DecodedSentence", "What a decoder found.")
      .def_readonly("complete", &hri::DecodedSentence::complete, "Whether it is a whole sentence.")
      .def_readonly("log_score", &hri::DecodedSentence::log_score, "Of the best path.")
      .def_readonly("words", &hri::DecodedSentence::words, "In the order of time.");
  py::class_<hri::ConnectedDecoder>(m, "ConnectedDecoder",
                                    "Token passing over a word network, frame by frame.")
      .def(py::init<const std::vector<hri::WordChain>&, const hri::WordNetwork&,
                    const hri::ConnectedDecoderOptions&>(),
           py::arg("chains"), py::arg("network"),
           py::arg_v("options", hri::ConnectedDecoderOptions(), "ConnectedDecoderOptions()"))
      .def(
          "push",
          [](hri::ConnectedDecoder& self, const FloatArray& log_emissions) {
            const auto frame = as_span(log_emissions, "log_emissions");
            const py::gil_scoped_release release;
            self.push(frame);
          },
          py::arg("log_emissions"), "One frame: log scores of all states, shape (num_states,).")
      .def(
          "push_all",
          [](hri::ConnectedDecoder& self, const FloatArray& log_emissions) {
            const auto matrix = as_matrix(log_emissions, "log_emissions");
            const py::gil_scoped_release release;
            for (Eigen::Index t = 0; t < matrix.rows(); ++t) self.push(hri::row_span(matrix, t));
          },
          py::arg("log_emissions"), "push() of every row.")
      .def("partial", &hri::ConnectedDecoder::partial, "The best hypothesis so far.")
      .def("take_decided", &hri::ConnectedDecoder::take_decided,
           "Words that change no more, since the last call.")
      .def("finish", &hri::ConnectedDecoder::finish,
           "The best sentence; then as before the first frame.")
      .def("reset", &hri::ConnectedDecoder::reset, "Back to before the first frame.")
      .def_property_readonly("num_states", &hri::ConnectedDecoder::num_states, "Of all models.")
      .def_property_readonly("num_frames", &hri::ConnectedDecoder::num_frames, "Pushed so far.")
      .def_property_readonly("num_active", &hri::ConnectedDecoder::num_active,
                             "States with a hypothesis.")
      .def_property_readonly("alive", &hri::ConnectedDecoder::alive,
                             "Whether any hypothesis is left.");
}

void bind_lattice(py::module_& m) {
  hri_bind::bind_options<hri::LatticeOptions>(m, "Options of Lattice.");
  py::class_<hri::ConfusionSlot>(m, "ConfusionSlot",
                                 "What may have been said in one place of a recording.")
      .def_readonly("first_frame", &hri::ConfusionSlot::first_frame, "First frame.")
      .def_readonly("last_frame", &hri::ConfusionSlot::last_frame, "One past the last frame.")
      .def_property_readonly(
          "entries",
          [](const hri::ConfusionSlot& self) {
            std::vector<std::pair<int, double>> entries;
            entries.reserve(self.entries.size());
            for (const auto& entry : self.entries)
              entries.emplace_back(entry.model, entry.probability);
            return entries;
          },
          "(model, probability), the most probable first; model -1: no word.");
  py::class_<hri::Lattice>(m, "Lattice", "All sentences of a recording that come near the best.")
      .def(py::init([](const std::vector<std::tuple<int, std::int64_t, bool>>& nodes,
                       const std::vector<std::tuple<int, int, double, double>>& arcs) {
             std::vector<hri::Lattice::Node> made_nodes;
             made_nodes.reserve(nodes.size());
             for (const auto& [model, frame, is_silence] : nodes)
               made_nodes.push_back({model, frame, is_silence});
             std::vector<hri::Lattice::Arc> made_arcs;
             made_arcs.reserve(arcs.size());
             for (const auto& [from, to, acoustic, weight] : arcs)
               made_arcs.push_back({from, to, acoustic, weight});
             return hri::Lattice(std::move(made_nodes), std::move(made_arcs));
           }),
           py::arg("nodes"), py::arg("arcs"),
           "A node is (model of the word that ends here or -1, frame, is_silence), an arc (from, "
           "to, log acoustic score, log weight).")
      .def_static(
          "decode",
          [](const std::vector<hri::WordChain>& chains, const hri::WordNetwork& network,
             const FloatArray& log_emissions, const hri::ConnectedDecoderOptions& options,
             const hri::LatticeOptions& lattice_options) {
            const auto matrix = as_matrix(log_emissions, "log_emissions");
            const py::gil_scoped_release release;
            return hri::Lattice::decode(chains, network, matrix, options, lattice_options);
          },
          py::arg("chains"), py::arg("network"), py::arg("log_emissions"),
          py::arg_v("options", hri::ConnectedDecoderOptions(), "ConnectedDecoderOptions()"),
          py::arg_v("lattice_options", hri::LatticeOptions(), "LatticeOptions()"),
          "Of log scores, shape (num_frames, num_states); exact, without the decoder's beam.")
      .def("best", &hri::Lattice::best, "The best sentence.")
      .def("n_best", &hri::Lattice::n_best, py::arg("count"),
           py::call_guard<py::gil_scoped_release>(),
           "At most `count` sentences that differ in their words, the best first.")
      .def(
          "posteriors",
          [](const hri::Lattice& self, double scale) { return to_array(self.posteriors(scale)); },
          py::arg("scale"), "Probability of every arc, float64; `scale` is on log scores.")
      .def("confidences", &hri::Lattice::confidences, py::arg("words"), py::arg("scale"),
           "For each of the words how probable it is that it was said there.")
      .def("confusion_network", &hri::Lattice::confusion_network, py::arg("scale"),
           "ConfusionSlots along the best sentence.")
      .def_property_readonly(
          "nodes",
          [](const hri::Lattice& self) {
            std::vector<std::tuple<int, std::int64_t, bool>> nodes;
            for (const auto& node : self.nodes())
              nodes.emplace_back(node.model, node.frame, node.is_silence);
            return nodes;
          },
          "(model, frame, is_silence).")
      .def_property_readonly(
          "arcs",
          [](const hri::Lattice& self) {
            std::vector<std::tuple<int, int, double, double>> arcs;
            for (const auto& arc : self.arcs())
              arcs.emplace_back(arc.from, arc.to, arc.log_acoustic, arc.log_weight);
            return arcs;
          },
          "(from, to, log acoustic score, log weight).")
      .def_property_readonly("empty", &hri::Lattice::empty, "Whether there is no sentence.");
}

void bind_grammar(py::module_& m) {
  py::class_<hri::Grammar>(m, "Grammar", "Commands with slots, in the JSpeech Grammar Format.")
      .def_static(
          "load", [](const hri_bind::Path& path) { return hri::Grammar::load(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>(),
          "Reads a file; raises FormatError naming file and line.")
      .def_static("parse", &hri::Grammar::parse, py::arg("text"), py::arg("name"),
                  py::call_guard<py::gil_scoped_release>(),
                  "The same of a text; `name` is what errors call it.")
      .def("slots_of", &hri::Grammar::slots_of, py::arg("sentence"),
           py::call_guard<py::gil_scoped_release>(),
           "The slots of a list of words; None for what is no sentence of the grammar, or has more "
           "than 10000 words.")
      .def("sentences", &hri::Grammar::sentences, py::arg("most") = 10000,
           py::call_guard<py::gil_scoped_release>(),
           "Every sentence once, as lists of words, in the grammar's order; raises InvalidArgument "
           "for more than `most`, for repetitions, which have no end, for a sentence of more than "
           "10000 words and for more than four million words in all.")
      .def("network", &hri::Grammar::network, py::arg("labels"), py::arg("silence") = -1,
           py::arg("unknown") = -1, py::call_guard<py::gil_scoped_release>(),
           "Its sentences as a WordNetwork; model i is labels[i].")
      .def_property_readonly("text", &hri::Grammar::text, "That was read.")
      .def_property_readonly("words", &hri::Grammar::words, "Sorted.");
}

void bind_emissions(py::module_& m) {
  py::class_<hri::GaussianEmissions>(m, "GaussianEmissions",
                                     "Log densities of the states of several models.")
      .def(py::init<std::vector<hri::GaussianMixtureHmm>>(), py::arg("models"))
      .def(
          "compute",
          [](const hri::GaussianEmissions& self, const FloatArray& frames) {
            const auto matrix = as_matrix(frames, "frames");
            hri::MatrixF out(matrix.rows(), self.num_states());
            {
              const py::gil_scoped_release release;
              self.compute(matrix, out);
            }
            return to_array(out);
          },
          py::arg("frames"), "float32, shape (num_frames, num_states).")
      .def_property_readonly("num_states", &hri::GaussianEmissions::num_states, "Of all models.");
  py::class_<hri::PossibilisticEmissions>(m, "PossibilisticEmissions",
                                          "Log possibilities of the states of a set of models.")
      .def(py::init<const hri::PossibilisticHmmSet&>(), py::arg("set"))
      .def(
          "compute",
          [](const hri::PossibilisticEmissions& self, const py::array& array) {
            const hri_bind::Integers symbols(array, "symbols");
            hri::MatrixF out(static_cast<Eigen::Index>(symbols.span().size()), self.num_states());
            Eigen::Index t = 0;
            for (const std::int32_t symbol : symbols.span()) {
              const auto row = self.of(symbol);
              std::copy(row.begin(), row.end(), out.row(t++).data());
            }
            return to_array(out);
          },
          py::arg("symbols"), "float32, a row for each symbol, shape (len(symbols), num_states).")
      .def_property_readonly("num_states", &hri::PossibilisticEmissions::num_states,
                             "Of all models.");
}

}  // namespace

void bind_language(py::module_& m) {
  bind_ngram_model(m);
  bind_network(m);
  bind_decoder(m);
  bind_lattice(m);
  bind_grammar(m);
  bind_emissions(m);
}
