// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HTK's models, dictionaries and word networks, and what recognises with them.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "core/arrays.hpp"
#include "core/paths.hpp"
#include "hri/htk/recognizer.hpp"

namespace py = pybind11;
using hri::htk::AlignedModel;
using hri::htk::AlignedState;
using hri::htk::Dictionary;
using hri::htk::ModelSet;
using hri::htk::Pronunciation;
using hri::htk::RecognisedSentence;
using hri::htk::RecognisedWord;
using hri::htk::Recognizer;
using hri::htk::WordLattice;
using hri_bind::FloatArray;
using hri_bind::Path;

namespace {

void bind_models(py::module_& m) {
  py::class_<ModelSet>(m, "HtkModelSet", "HTK's model definitions: HMMs of Gaussian mixtures.")
      .def(py::init([](const std::string& kind) {
             ModelSet made;
             made.kind = hri::htk::ParameterKind::parse(kind);
             return made;
           }),
           py::arg("kind") = "ANON")
      .def(
          "read", [](ModelSet& self, const Path& path) { self.read(path.text); }, py::arg("path"),
          "Adds what a file defines; raises FormatError naming file and line.")
      .def("parse", &ModelSet::parse, py::arg("text"), py::arg("name"),
           "The same of a text; `name` is what errors call it.")
      .def("to_text", py::overload_cast<>(&ModelSet::to_text, py::const_), "The text of a file.")
      .def(
          "write", [](const ModelSet& self, const Path& path) { self.write(path.text); },
          py::arg("path"), "Writes a file.")
      .def(
          "write_part",
          [](const ModelSet& self, const Path& path, std::size_t first, std::size_t last) {
            self.write(path.text, first, last);
          },
          py::arg("path"), py::arg("first"), py::arg("last"),
          "Writes the definitions first..last - 1, which may use those before.")
      .def("add", &ModelSet::add, py::arg("name"), py::arg("model"), py::arg("final_stay"),
           "Adds a left-right HMM, whose last state is left with 1 - final_stay.")
      .def("reorder", &ModelSet::reorder, py::arg("order"),
           "The definitions in another order: the number of each, once.")
      .def_property_readonly(
          "definitions",
          [](const ModelSet& self) {
            std::vector<std::pair<std::string, std::string>> all;
            all.reserve(self.macros.size());
            for (const auto& macro : self.macros)
              all.emplace_back(std::string(1, macro.type), macro.name);
            return all;
          },
          "(type, name) of every definition in order; type is one of h s m u v t.")
      .def("rename_hmm", &ModelSet::rename_hmm, py::arg("hmm"), py::arg("name"), "Renames an HMM.")
      .def(
          "hmm",
          [](const ModelSet& self, const std::string& name) {
            const auto* macro = self.find('h', name);
            if (macro == nullptr)
              hri::fail(hri::ErrorKind::invalid_argument, "there is no model '" + name + "'");
            return hri::htk::to_hmm(macro->hmm);
          },
          py::arg("name"), "Its Gaussians, and its chain without entry and exit.")
      .def(
          "transitions",
          [](const ModelSet& self, const std::string& name) {
            const auto* macro = self.find('h', name);
            if (macro == nullptr)
              hri::fail(hri::ErrorKind::invalid_argument, "there is no model '" + name + "'");
            return hri_bind::to_array(macro->hmm.transitions.values);
          },
          py::arg("name"), "Its transitions with entry and exit, float64.")
      .def_property_readonly("num_codewords", &ModelSet::num_codewords,
                             "Of discrete models, whose frames have one column of them, from 1; "
                             "0: the models are of Gaussians.")
      .def(
          "discrete",
          [](const ModelSet& self, const std::string& name) {
            const auto* macro = self.find('h', name);
            if (macro == nullptr)
              hri::fail(hri::ErrorKind::invalid_argument, "there is no model '" + name + "'");
            const auto& states = macro->hmm.states;
            hri::require(!states.empty() && states.front().discrete.size() > 0,
                         "the model is of Gaussians");
            hri::MatrixD values(static_cast<Eigen::Index>(states.size()),
                                states.front().discrete.size());
            for (std::size_t s = 0; s < states.size(); ++s)
              values.row(static_cast<Eigen::Index>(s)) = states[s].discrete;
            return hri_bind::to_array(values);
          },
          py::arg("name"),
          "Probabilities of a discrete model, float64, shape (num_states, num_codewords).")
      .def_property_readonly("hmm_names", &ModelSet::hmm_names, "Names of the HMMs.")
      .def_property_readonly(
          "num_definitions", [](const ModelSet& self) { return self.macros.size(); },
          "HMMs and macros.")
      .def_readonly("vector_size", &ModelSet::vector_size, "Columns of a frame; 0: not set.")
      .def_property_readonly(
          "kind", [](const ModelSet& self) { return self.kind.text(); }, "Of the frames.");
}

void bind_htk_words(py::module_& m) {
  py::class_<Pronunciation>(m, "HtkPronunciation", "A word and the models that it is made of.")
      .def(py::init([](std::string word, std::vector<std::string> models,
                       const std::optional<std::string>& output, double probability) {
             Pronunciation made;
             made.word = std::move(word);
             made.has_output = output.has_value();
             made.output = output.value_or("");
             made.probability = probability;
             made.models = std::move(models);
             return made;
           }),
           py::arg("word"), py::arg("models"), py::arg("output") = py::none(),
           py::arg("probability") = 1.0)
      .def_readonly("word", &Pronunciation::word, "As networks have it.")
      .def_readonly("models", &Pronunciation::models, "Names of models.")
      .def_readonly("probability", &Pronunciation::probability, "Among those of the word.")
      .def_readonly("line", &Pronunciation::line, "Of the file that it was read from; 0: of none.")
      .def_property_readonly(
          "output",
          [](const Pronunciation& self) { return self.has_output ? self.output : self.word; },
          "What is printed for it; empty: nothing.");
  py::class_<Dictionary>(m, "HtkDictionary", "Pronunciations of words.")
      .def(py::init(
               [](std::vector<Pronunciation> entries) { return Dictionary{std::move(entries)}; }),
           py::arg("entries") = std::vector<Pronunciation>{})
      .def_static(
          "read", [](const Path& path) { return Dictionary::read(path.text); }, py::arg("path"),
          "Raises FormatError naming file and line.")
      .def_static("parse", &Dictionary::parse, py::arg("text"), py::arg("name"),
                  "The same of a text; `name` is what errors call it.")
      .def("to_text", &Dictionary::to_text, "The text of the file.")
      .def(
          "write", [](const Dictionary& self, const Path& path) { self.write(path.text); },
          py::arg("path"), "Writes the file.")
      .def_readonly("entries", &Dictionary::entries, "In the order of the file.");
  py::class_<WordLattice>(m, "HtkWordLattice", "A word network: words on nodes, weights on arcs.")
      .def(py::init([](std::vector<std::string> words,
                       const std::vector<std::tuple<int, int, double>>& arcs) {
             WordLattice made;
             made.words = std::move(words);
             for (const auto& [from, to, log_weight] : arcs)
               made.arcs.push_back({from, to, log_weight, 0});
             if (const std::string fault = made.fault(); !fault.empty())
               hri::fail(hri::ErrorKind::invalid_argument, fault);
             return made;
           }),
           py::arg("words"), py::arg("arcs"), "An arc is (from, to, log weight).")
      .def_static(
          "read", [](const Path& path) { return WordLattice::read(path.text); }, py::arg("path"),
          "Reads a file in standard lattice format; raises FormatError naming file and line.")
      .def_static("parse", &WordLattice::parse, py::arg("text"), py::arg("name"),
                  "The same of a text; `name` is what errors call it.")
      .def_static("of_grammar", &WordLattice::of_grammar, py::arg("text"), py::arg("name"),
                  "The network of a grammar in HParse's form.")
      .def_static(
          "read_grammar", [](const Path& path) { return WordLattice::read_grammar(path.text); },
          py::arg("path"), "The same of a file.")
      .def_static("of_bigram", &WordLattice::of_bigram, py::arg("language"), py::arg("words"),
                  py::arg("start") = hri::NGramModel::kStart,
                  py::arg("end") = hri::NGramModel::kEnd,
                  "Words in any order, weighted by an NGramModel of order 1 or 2.")
      .def_static("of_words", &WordLattice::of_words, py::arg("words"),
                  "The one sentence, for forced alignment.")
      .def("to_text", &WordLattice::to_text, "The text of the file.")
      .def(
          "write", [](const WordLattice& self, const Path& path) { self.write(path.text); },
          py::arg("path"), "Writes the file.")
      .def_readonly("words", &WordLattice::words, "Of the nodes; !NULL: none.")
      .def_property_readonly(
          "arcs",
          [](const WordLattice& self) {
            std::vector<std::tuple<int, int, double>> arcs;
            arcs.reserve(self.arcs.size());
            for (const auto& arc : self.arcs) arcs.emplace_back(arc.from, arc.to, arc.log_weight);
            return arcs;
          },
          "(from, to, log weight).")
      .def_static("of_lattice", &WordLattice::of_lattice, py::arg("lattice"), py::arg("labels"),
                  py::arg("first_s"), py::arg("frame_s"), py::arg("language_scale") = 1.0,
                  py::arg("insertion_penalty") = 0.0,
                  "A hri.language.Lattice as a file: labels of its models, frame n at first_s + n "
                  "frame_s. Scale and penalty that its weights hold are taken out.")
      .def("to_lattice", &WordLattice::to_lattice, py::arg("labels"),
           py::arg("silences") = std::vector<std::string>{}, py::arg("first_s") = 0.0,
           py::arg("frame_s") = 0.01,
           "The same back, weighed again; words of `silences` are silence. Raises InvalidArgument "
           "for a file "
           "without times.")
      .def_readonly("lines", &WordLattice::lines,
                    "Of the file that the nodes were read from; empty: of none.")
      .def_readonly("variants", &WordLattice::variants,
                    "Pronunciation of every node, from 1, 0: any; or empty.")
      .def_readonly("language_scale", &WordLattice::language_scale,
                    "That weights had in recognition.")
      .def_readonly("insertion_penalty", &WordLattice::insertion_penalty,
                    "That every word had in recognition.")
      .def_readonly("times_s", &WordLattice::times_s, "Where the words of the nodes end, or empty.")
      .def_property_readonly("first", &WordLattice::first, "The node that begins sentences.")
      .def_property_readonly("last", &WordLattice::last, "The node that ends them.");
}

void bind_recognizer(py::module_& m) {
  py::class_<RecognisedWord>(m, "HtkRecognisedWord", "A word of a recognised sentence.")
      .def_readonly("word", &RecognisedWord::word, "As the network has it.")
      .def_readonly("output", &RecognisedWord::output, "What is printed for it; empty: nothing.")
      .def_readonly("first_frame", &RecognisedWord::first_frame, "First frame.")
      .def_readonly("last_frame", &RecognisedWord::last_frame, "One past the last frame.")
      .def_readonly("log_score", &RecognisedWord::log_score, "What it adds to the sentence's.")
      .def_readonly("pronunciation", &RecognisedWord::pronunciation,
                    "Its entry in the dictionary.");
  py::class_<AlignedState>(m, "HtkAlignedState", "A state on the best path through a model.")
      .def_readonly("state", &AlignedState::state, "As HTK counts: the entry is 1.")
      .def_readonly("first_frame", &AlignedState::first_frame, "First frame.")
      .def_readonly("last_frame", &AlignedState::last_frame, "One past the last frame.")
      .def_readonly("log_score", &AlignedState::log_score,
                    "Of its frames, and of the steps into it and on from it.");
  py::class_<AlignedModel>(m, "HtkAlignedModel", "A model of a recognised word.")
      .def_readonly("model", &AlignedModel::model, "Its name.")
      .def_readonly("first_frame", &AlignedModel::first_frame, "First frame.")
      .def_readonly("last_frame", &AlignedModel::last_frame,
                    "One past the last frame; the first where it was passed without a frame.")
      .def_readonly("log_score", &AlignedModel::log_score, "Of its frames and steps.")
      .def_readonly("states", &AlignedModel::states, "In the order of time.");
  py::class_<RecognisedSentence>(m, "HtkRecognisedSentence", "What a recogniser found.")
      .def_readonly("complete", &RecognisedSentence::complete, "Whether it is a whole sentence.")
      .def_readonly("log_score", &RecognisedSentence::log_score, "Of the best path.")
      .def_readonly("words", &RecognisedSentence::words, "In the order of time.");
  py::class_<Recognizer>(m, "HtkRecognizer", "HVite: models, dictionary and network of words.")
      .def(py::init<const ModelSet&, const Dictionary&, const WordLattice&,
                    const hri::ConnectedDecoderOptions&>(),
           py::arg("models"), py::arg("dictionary"), py::arg("lattice"),
           py::arg_v("options", hri::ConnectedDecoderOptions(), "ConnectedDecoderOptions()"))
      .def(
          "recognise",
          [](const Recognizer& self, const FloatArray& observations) {
            const auto frames = hri_bind::as_matrix(observations, "observations");
            const py::gil_scoped_release release;
            return self.recognise(frames);
          },
          py::arg("observations"), "The best sentence of frames, shape (num_frames, num_columns).")
      .def(
          "lattice",
          [](const Recognizer& self, const FloatArray& observations,
             const hri::LatticeOptions& options) {
            const auto frames = hri_bind::as_matrix(observations, "observations");
            const py::gil_scoped_release release;
            return self.lattice(frames, options);
          },
          py::arg("observations"),
          py::arg_v("options", hri::LatticeOptions{1000, 200000},
                    "LatticeOptions(beam=1000, max_arcs=200000)"),
          "All sentences near the best; model i is the pronunciation of words[i].")
      .def(
          "align",
          [](const Recognizer& self, const FloatArray& observations,
             const RecognisedSentence& sentence) {
            const auto frames = hri_bind::as_matrix(observations, "observations");
            const py::gil_scoped_release release;
            return self.align(frames, sentence);
          },
          py::arg("observations"), py::arg("sentence"),
          "Models and states of every word of a sentence of these frames.")
      .def("n_best", &Recognizer::n_best, py::arg("lattice"), py::arg("count"),
           py::call_guard<py::gil_scoped_release>(),
           "At most `count` (1..1000) sentences of a lattice of this recogniser that differ in "
           "their words, the best first.")
      .def_property_readonly("options", &Recognizer::options, py::return_value_policy::copy,
                             "Those that it was made with.")
      .def_property_readonly("words", &Recognizer::words, "Of every pronunciation.");
}

}  // namespace

void bind_htk_models(py::module_& m) {
  bind_models(m);
  bind_htk_words(m);
  bind_recognizer(m);
}
