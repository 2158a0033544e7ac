// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Training of HTK's models together: flat start, embedded Baum-Welch, and changes of structure.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"
#include "hri/htk/edit_script.hpp"
#include "hri/htk/embedded_trainer.hpp"
#include "hri/htk/flat_start.hpp"
#include "hri/htk/viterbi_trainer.hpp"

namespace py = pybind11;
using hri::htk::EditScript;
using hri::htk::EmbeddedTrainer;
using hri::htk::EmbeddedTrainerOptions;
using hri::htk::FlatStart;
using hri::htk::ModelOccupation;
using hri::htk::ModelSet;
using hri::htk::ViterbiTrainerOptions;
using hri::htk::ViterbiTraining;
using hri_bind::FloatArray;
using hri_bind::Path;

void bind_htk_training(py::module_& m) {
  py::class_<FlatStart>(m, "HtkFlatStart", "HCompV: models at the mean and variance of all frames.")
      .def(py::init<>())
      .def(
          "add",
          [](FlatStart& self, const FloatArray& frames) {
            const auto matrix = hri_bind::as_matrix(frames, "frames");
            const py::gil_scoped_release release;
            self.add(matrix);
          },
          py::arg("frames"), "Adds frames, shape (num_frames, num_columns).")
      .def_property_readonly("num_frames", &FlatStart::num_frames, "Frames added.")
      .def_property_readonly(
          "mean", [](const FlatStart& self) { return hri_bind::to_array(self.mean()); },
          "Of all frames, float64.")
      .def_property_readonly(
          "variance", [](const FlatStart& self) { return hri_bind::to_array(self.variance()); },
          "Of all frames, divided by their number, float64.")
      .def("apply", &FlatStart::apply, py::arg("models"), py::arg("update_means"),
           py::arg("min_variance") = 0.0,
           "The models with the variance in every Gaussian, and with update_means the mean.")
      .def("variance_floors", &FlatStart::variance_floors, py::arg("share"),
           "The macro varFloor1, of this share of the variance.");

  hri_bind::bind_options<ViterbiTrainerOptions>(m, "Options of training by best paths.");
  py::class_<ViterbiTraining>(m, "HtkViterbiTraining", "What training by best paths gave.")
      .def_readonly("models", &ViterbiTraining::models, "All of the set.")
      .def_readonly("log_probabilities", &ViterbiTraining::log_probabilities,
                    "Of the best paths before each pass, all recordings together; natural log.")
      .def_readonly("converged", &ViterbiTraining::converged, "Or the passes were at their end.");
  m.def(
      "train_htk_model_by_viterbi",
      [](const ModelSet& models, const std::string& hmm, const std::vector<FloatArray>& recordings,
         const ViterbiTrainerOptions& options) {
        std::vector<hri::MatrixF> all;
        all.reserve(recordings.size());
        for (const FloatArray& one : recordings)
          all.emplace_back(hri_bind::as_matrix(one, "recordings"));
        const py::gil_scoped_release release;
        return hri::htk::train_by_viterbi(models, hmm, all, options);
      },
      py::arg("models"), py::arg("hmm"), py::arg("recordings"),
      py::arg_v("options", ViterbiTrainerOptions(), "ViterbiTrainerOptions()"),
      "HInit: a model from recordings of its unit, each of shape (num_frames, num_columns); its "
      "topology, number of Gaussians and macros stay.");
  m.def("min_frames_of_htk_model", &hri::htk::min_frames_of, py::arg("models"), py::arg("hmm"),
        "Frames on the shortest way through a model.");

  hri_bind::bind_options<EmbeddedTrainerOptions>(m, "Options of embedded Baum-Welch.");
  py::class_<ModelOccupation>(m, "HtkModelOccupation", "How often a model was met in training.")
      .def_readonly("name", &ModelOccupation::name, "Of the model.")
      .def_readonly("num_examples", &ModelOccupation::num_examples, "In the transcripts.")
      .def_readonly("states", &ModelOccupation::states, "Expected frames of its states.");
  py::class_<EmbeddedTrainer>(m, "HtkEmbeddedTrainer",
                              "HERest: one pass of Baum-Welch from transcripts without times.")
      .def(py::init<const ModelSet&, const EmbeddedTrainerOptions&>(), py::arg("models"),
           py::arg_v("options", EmbeddedTrainerOptions(), "EmbeddedTrainerOptions()"))
      .def(
          "add",
          [](EmbeddedTrainer& self, const FloatArray& frames,
             const std::vector<std::string>& units) {
            const auto matrix = hri_bind::as_matrix(frames, "frames");
            const py::gil_scoped_release release;
            return std::string(hri::enum_name(self.add(matrix, units)));
          },
          py::arg("frames"), py::arg("units"),
          "Adds an utterance, shape (num_frames, num_columns), by the names of its models; gives "
          "'added', 'too_short' or 'impossible'.")
      .def(
          "write_sums",
          [](const EmbeddedTrainer& self, const Path& path) { self.write_sums(path.text); },
          py::arg("path"), "Writes the sums over the utterances added, for add_sums().")
      .def(
          "add_sums", [](EmbeddedTrainer& self, const Path& path) { self.add_sums(path.text); },
          py::arg("path"),
          "As if the utterances that a file of write_sums() sums up were added here; raises "
          "FormatError for sums of other models.")
      .def("estimate", &EmbeddedTrainer::estimate,
           "The models that the utterances added make most likely.")
      .def_property_readonly("log_likelihood", &EmbeddedTrainer::log_likelihood,
                             "Of the utterances added, before estimation; natural log.")
      .def_property_readonly("num_frames", &EmbeddedTrainer::num_frames, "Frames added.")
      .def("occupations", &EmbeddedTrainer::occupations,
           "Of every model, in the order of the set.");

  py::class_<EditScript>(m, "HtkEditScript", "HHEd: commands that change the structure of models.")
      .def_static(
          "read", [](const Path& path) { return EditScript::read(path.text); }, py::arg("path"),
          "Raises FormatError naming file and line.")
      .def_static("parse", &EditScript::parse, py::arg("text"), py::arg("name"),
                  "The same of a text; `name` is what errors call it.")
      .def(
          "apply",
          [](const EditScript& self, const ModelSet& models) { return self.apply(models); },
          py::arg("models"),
          "The models after all commands; raises FormatError for items that no model has.")
      .def(
          "apply_with_files",
          [](const EditScript& self, const ModelSet& models) {
            std::vector<hri::htk::EditedFile> files;
            ModelSet made = self.apply(models, &files);
            std::vector<std::pair<std::string, std::string>> texts;
            texts.reserve(files.size());
            for (auto& file : files) texts.emplace_back(std::move(file.path), std::move(file.text));
            return std::make_pair(std::move(made), std::move(texts));
          },
          py::arg("models"),
          "The same, and (path, text) of the files that CO and ST want written, which are not.")
      .def_property_readonly(
          "num_commands", [](const EditScript& self) { return self.commands.size(); }, "Commands.");
}
