// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// HTK's parameter, configuration and label files.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "core/paths.hpp"
#include "hri/htk/configuration.hpp"
#include "hri/htk/feature_extractor.hpp"
#include "hri/htk/labels.hpp"
#include "hri/htk/parameter_file.hpp"
#include "hri/htk/vq_table.hpp"

namespace py = pybind11;
using hri::htk::Configuration;
using hri::htk::FeatureExtractor;
using hri::htk::HtkFeatureOptions;
using hri::htk::Label;
using hri::htk::MasterLabelFile;
using hri::htk::ParameterFile;
using hri::htk::ParameterKind;
using hri::htk::Transcription;
using hri::htk::VqTable;
using hri_bind::FloatArray;
using hri_bind::Path;

namespace {

using Release = py::call_guard<py::gil_scoped_release>;

hri::Span<const std::uint8_t> as_bytes(const std::string& text) {
  // Bytes of a file, whatever the sign of char.
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

auto fields_of(const hri::htk::ParameterHeader& header) {
  return std::make_tuple(header.kind.text(), header.sample_period, header.num_frames,
                         header.num_columns);
}

void bind_parameters(py::module_& m) {
  py::class_<ParameterFile>(m, "HtkParameterFile", "Frames of an HTK parameter file, in rows.")
      .def(py::init([](const FloatArray& values, const std::string& kind, int sample_period) {
             ParameterFile file;
             file.values = hri_bind::as_matrix(values, "values");
             file.kind = ParameterKind::parse(kind);
             file.sample_period = sample_period;
             return file;
           }),
           py::arg("values"), py::arg("kind"), py::arg("sample_period") = 100000)
      .def_static(
          "read", [](const Path& path) { return ParameterFile::read(path.text); }, py::arg("path"),
          Release(), "Raises FormatError naming file and byte.")
      .def_static(
          "parse_header",
          [](const py::bytes& data, const std::string& name) {
            const auto text = static_cast<std::string>(data);
            return fields_of(hri::htk::ParameterHeader::parse(as_bytes(text), name));
          },
          py::arg("data"), py::arg("name"),
          "(kind, sample_period, num_frames, num_columns) of the first 12 bytes.")
      .def_static(
          "read_header",
          [](const Path& path) { return fields_of(hri::htk::ParameterHeader::read(path.text)); },
          py::arg("path"),
          "The same of a file, of which no more is read; raises FormatError also where the file "
          "has another size than the header says.")
      .def_static(
          "read_frames",
          [](const Path& path, std::int64_t first, std::int64_t last) {
            return ParameterFile::read_frames(path.text, first, last);
          },
          py::arg("path"), py::arg("first"), py::arg("last"), Release(),
          "Frames first .. last - 1 alone, as `read` has them, in memory for these. A checksum is "
          "checked only where these are all. Raises FormatError also where the file has fewer "
          "frames, InvalidArgument unless 0 <= first < last.")
      .def_static(
          "verify", [](const Path& path) { ParameterFile::verify(path.text); }, py::arg("path"),
          Release(),
          "Raises FormatError for a header, a size and a checksum that are wrong; takes memory of "
          "a fixed size.")
      .def_static(
          "frames_beside",
          [](const std::string& kind, const std::string& target, const HtkFeatureOptions& options) {
            return hri::htk::frames_beside(ParameterKind::parse(kind), ParameterKind::parse(target),
                                           options);
          },
          py::arg("kind"), py::arg("target"),
          py::arg_v("options", HtkFeatureOptions(), "HtkFeatureOptions()"),
          "How many frames on each side a frame takes to become of the kind `target`; None: all.")
      .def_static(
          "parse",
          [](const py::bytes& data, const std::string& name) {
            const auto text = static_cast<std::string>(data);
            return ParameterFile::parse(as_bytes(text), name);
          },
          py::arg("data"), py::arg("name"), "The same of bytes; `name` is what errors call them.")
      .def(
          "write", [](const ParameterFile& self, const Path& path) { self.write(path.text); },
          py::arg("path"), Release(), "With _C in `kind` compressed, with _K with a checksum.")
      .def(
          "serialise",
          [](const ParameterFile& self) {
            const std::vector<std::uint8_t> data = self.serialise();
            return py::bytes(reinterpret_cast<const char*>(data.data()), data.size());
          },
          "The bytes of the file.")
      .def_property_readonly(
          "kind", [](const ParameterFile& self) { return self.kind.text(); }, "Such as MFCC_E_D.")
      .def_readonly("sample_period", &ParameterFile::sample_period,
                    "From frame to frame, in 100 ns.")
      .def_property_readonly(
          "values", [](const ParameterFile& self) { return hri_bind::to_array(self.values); },
          "float32, shape (num_frames, num_columns).")
      .def(
          "convert",
          [](const ParameterFile& self, const std::string& kind, const HtkFeatureOptions& options) {
            return hri::htk::convert(self, ParameterKind::parse(kind), options);
          },
          py::arg("kind"), py::arg_v("options", HtkFeatureOptions(), "HtkFeatureOptions()"),
          "As another kind of the same base: differences are added or left out.")
      .def(
          "observations",
          [](const ParameterFile& self, const std::string& kind, const HtkFeatureOptions& options) {
            return hri_bind::to_array(
                hri::htk::observations(self, ParameterKind::parse(kind), options));
          },
          py::arg("kind"), py::arg_v("options", HtkFeatureOptions(), "HtkFeatureOptions()"),
          "Frames as models of this kind see them, float32, shape (num_frames, num_columns).");
}

void bind_features(py::module_& m) {
  py::class_<FeatureExtractor>(m, "HtkFeatureExtractor",
                               "Audio to MFCC, FBANK, MELSPEC, LPC or LPCEPSTRA as HTK's.")
      .def(py::init(
               [](const std::string& kind, int sample_rate_hz, const HtkFeatureOptions& options) {
                 return FeatureExtractor(ParameterKind::parse(kind), sample_rate_hz, options);
               }),
           py::arg("kind"), py::arg("sample_rate_hz"),
           py::arg_v("options", HtkFeatureOptions(), "HtkFeatureOptions()"))
      .def(
          "compute",
          [](const FeatureExtractor& self, const FloatArray& audio) {
            return hri_bind::to_array(self.compute(hri_bind::as_span(audio, "audio")));
          },
          py::arg("audio"), "float32, shape (num_frames, num_columns); full scale is -1..1.")
      .def_property_readonly("num_columns", &FeatureExtractor::num_columns, "Of a frame.")
      .def_property_readonly("sample_period", &FeatureExtractor::sample_period,
                             "From frame to frame, in 100 ns.");
  py::class_<Configuration>(m, "HtkConfiguration", "What HTK's configuration files set.")
      .def(py::init([](bool live) {
             Configuration made;
             made.live = live;
             return made;
           }),
           py::arg("live") = false,
           "With `live` that of live sound, whose settings are refused or set nothing else.")
      .def(
          "read", [](Configuration& self, const Path& path) { self.read(path.text); },
          py::arg("path"), "Sets what a file sets; raises FormatError naming file and line.")
      .def("parse", &Configuration::parse, py::arg("text"), py::arg("name"),
           "The same of a text; `name` is what errors call it.")
      .def(
          "written_kind",
          [](const Configuration& self, const std::string& source) {
            return self.written_kind(ParameterKind::parse(source)).text();
          },
          py::arg("source"), "The kind of files to write, _C and _K included.")
      .def_property_readonly(
          "target", [](const Configuration& self) { return self.target.text(); }, "TARGETKIND.")
      .def_property_readonly(
          "source_format",
          [](const Configuration& self) { return hri::enum_name(self.source_format); },
          "SOURCEFORMAT: HTK or WAV.")
      .def_readonly("has_target_rate", &Configuration::has_target_rate,
                    "Whether TARGETRATE is set.")
      .def_readonly("has_codewords", &Configuration::has_codewords, "Whether TARGETKIND has _V.")
      .def_readonly("save_codewords", &Configuration::save_codewords, "SAVEASVQ.")
      .def_readonly("vq_table", &Configuration::vq_table, "VQTABLE; empty: not set.")
      .def_readonly("live", &Configuration::live, "Whether it is of live sound.")
      .def_readonly("source_rate_hz", &Configuration::source_rate_hz,
                    "SOURCERATE of live sound, as a rate; 0: not set.")
      .def_readonly("silence_frames", &Configuration::silence_frames,
                    "SILSEQCOUNT of live sound: frames that end an utterance; 0: not set.")
      .def_readonly("record_prefix", &Configuration::record_prefix, "RECOUTPREFIX of live sound.")
      .def_readonly("record_suffix", &Configuration::record_suffix, "RECOUTSUFFIX of live sound.")
      .def_readonly("features", &Configuration::features, "As HtkFeatureOptions.")
      .def_readonly("settings", &Configuration::settings,
                    "Pairs of a key and a value, as they came.")
      .def_readonly("ignored", &Configuration::ignored, "Keys that set nothing here.");
}

void bind_tables(py::module_& m) {
  py::class_<VqTable>(m, "HtkVqTable", "Codewords that frames become for discrete models.")
      .def(
          py::init([](const FloatArray& codewords, const std::string& kind,
                      const std::optional<FloatArray>& deviation) {
            hri::VectorF deviations;
            if (deviation.has_value()) {
              const auto values = hri_bind::as_span(*deviation, "deviation");
              deviations = Eigen::Map<const hri::VectorF>(values.data(),
                                                          static_cast<Eigen::Index>(values.size()));
            }
            const hri::Codebook codebook(hri::MatrixF(hri_bind::as_matrix(codewords, "codewords")));
            return VqTable::of_codebook(codebook, ParameterKind::parse(kind), deviations);
          }),
          py::arg("codewords"), py::arg("kind") = "ANON", py::arg("deviation") = py::none(),
          "`codewords` (num_codewords, num_columns), of frames of this kind; `deviation` "
          "(num_columns,): these were divided by it, and distances are by variances. Raises "
          "InvalidArgument for more than 4096 codewords, and a deviation that is not above 0.")
      .def_static(
          "read", [](const Path& path) { return VqTable::read(path.text); }, py::arg("path"),
          "Raises FormatError naming file and line.")
      .def_static("parse", &VqTable::parse, py::arg("text"), py::arg("name"),
                  "The same of a text; `name` is what errors call it.")
      .def("to_text", &VqTable::to_text, "The text of the file.")
      .def(
          "write", [](const VqTable& self, const Path& path) { self.write(path.text); },
          py::arg("path"), "Writes the file.")
      .def(
          "quantise",
          [](const VqTable& self, const FloatArray& frames) {
            const hri::MatrixF rows = hri_bind::as_matrix(frames, "frames");
            std::vector<std::int32_t> codewords;
            {
              const py::gil_scoped_release release;
              codewords = self.quantise(rows);
            }
            return hri_bind::to_array(codewords);
          },
          py::arg("frames"),
          "The nearest codeword of every row, from 1, int32, shape (num_frames,).")
      .def_property_readonly(
          "kind", [](const VqTable& self) { return self.kind.text(); }, "Of the frames; ANON: any.")
      .def_property_readonly("num_codewords", &VqTable::num_codewords, "Codewords.")
      .def_property_readonly("dim", &VqTable::dim, "Columns of a frame.");
}

void bind_labels(py::module_& m) {
  py::class_<Label>(m, "HtkLabel", "A name with times in 100 ns and a score, where it has them.")
      .def(py::init([](std::string name, std::optional<std::int64_t> first,
                       std::optional<std::int64_t> last, std::optional<double> score,
                       const std::vector<std::pair<std::string, std::optional<double>>>& others) {
             Label label;
             label.name = std::move(name);
             label.first = first.value_or(Label::kNoTime);
             label.last = last.value_or(Label::kNoTime);
             label.has_score = score.has_value();
             label.score = score.value_or(0);
             for (const auto& [also, value] : others)
               label.auxiliary.push_back({also, value.has_value(), value.value_or(0)});
             return label;
           }),
           py::arg("name"), py::arg("first") = py::none(), py::arg("last") = py::none(),
           py::arg("score") = py::none(),
           py::arg("others") = std::vector<std::pair<std::string, std::optional<double>>>{},
           "`others` are further levels of the transcription: names with scores, or None.")
      .def_property_readonly(
          "others",
          [](const Label& self) {
            std::vector<std::pair<std::string, std::optional<double>>> others;
            others.reserve(self.auxiliary.size());
            for (const auto& one : self.auxiliary)
              others.emplace_back(one.name,
                                  one.has_score ? std::optional(one.score) : std::nullopt);
            return others;
          },
          "Names and scores of further levels.")
      .def_readonly("name", &Label::name, "What was said.")
      .def_readonly("line", &Label::line, "Of the file that it was read from, from 1; 0: of none.")
      .def_property_readonly(
          "first",
          [](const Label& self) {
            return self.first == Label::kNoTime ? std::nullopt : std::optional(self.first);
          },
          "Where it begins, in 100 ns.")
      .def_property_readonly(
          "last",
          [](const Label& self) {
            return self.last == Label::kNoTime ? std::nullopt : std::optional(self.last);
          },
          "Where it ends, in 100 ns.")
      .def_property_readonly(
          "score",
          [](const Label& self) {
            return self.has_score ? std::optional(self.score) : std::nullopt;
          },
          "Its score.");
  py::class_<Transcription>(m, "HtkTranscription", "The labels of one recording.")
      .def(py::init([](std::vector<Label> labels, std::vector<std::vector<Label>> others) {
             Transcription made;
             made.alternatives = std::move(others);
             made.alternatives.insert(made.alternatives.begin(), std::move(labels));
             return made;
           }),
           py::arg("labels"), py::arg("others") = std::vector<std::vector<Label>>())
      .def_static(
          "read", [](const Path& path) { return Transcription::read(path.text); }, py::arg("path"),
          "Reads a label file; raises FormatError naming file and line.")
      .def_static("parse", &Transcription::parse, py::arg("text"), py::arg("name"),
                  "The same of a text; `name` is what errors call it.")
      .def("to_text", &Transcription::to_text, "The text of a label file.")
      .def(
          "write", [](const Transcription& self, const Path& path) { self.write(path.text); },
          py::arg("path"), "Writes a label file.")
      .def_property_readonly("labels", &Transcription::labels, "Of the first alternative.")
      .def_readonly("alternatives", &Transcription::alternatives, "Labels of each.");
  py::class_<MasterLabelFile>(m, "HtkMasterLabelFile",
                              "Transcriptions by patterns of the names of their label files.")
      .def(py::init([](const std::vector<std::pair<std::string, Transcription>>& entries) {
             MasterLabelFile made;
             for (const auto& [pattern, transcription] : entries)
               made.entries.push_back({pattern, transcription, "", false});
             return made;
           }),
           py::arg("entries") = std::vector<std::pair<std::string, Transcription>>{})
      .def_static(
          "read", [](const Path& path) { return MasterLabelFile::read(path.text); },
          py::arg("path"), "Raises FormatError naming file and line.")
      .def_static("parse", &MasterLabelFile::parse, py::arg("text"), py::arg("name"),
                  "The same of a text; `name` is what errors call it.")
      .def("to_text", &MasterLabelFile::to_text, "The text of the file.")
      .def(
          "write", [](const MasterLabelFile& self, const Path& path) { self.write(path.text); },
          py::arg("path"), "Writes the file.")
      .def(
          "search",
          [](const MasterLabelFile& self, const std::string& name) {
            using Folder = std::pair<std::string, bool>;
            std::vector<std::variant<Transcription, Folder>> found;
            for (const auto& entry : self.entries) {
              if (!hri::htk::matches(entry.pattern, name)) continue;
              if (entry.folder.empty()) {
                found.emplace_back(entry.transcription);
              } else {
                found.emplace_back(Folder(entry.folder, entry.is_searched));
              }
            }
            return found;
          },
          py::arg("name"),
          "What the patterns that match the name of a label file stand for, in their order: a "
          "transcription, or the folder where it is and whether folders of the name may stand in "
          "it (=>).")
      .def_property_readonly(
          "folder_patterns",
          [](const MasterLabelFile& self) {
            std::vector<std::string> patterns;
            for (const auto& entry : self.entries) {
              if (!entry.folder.empty()) patterns.push_back(entry.pattern);
            }
            return patterns;
          },
          "Patterns that stand for a folder.")
      .def_property_readonly(
          "entries",
          [](const MasterLabelFile& self) {
            std::vector<std::pair<std::string, Transcription>> entries;
            entries.reserve(self.entries.size());
            for (const auto& entry : self.entries)
              entries.emplace_back(entry.pattern, entry.transcription);
            return entries;
          },
          "Pairs of a pattern and a transcription.");
}

}  // namespace

void bind_htk_files(py::module_& m) {
  hri_bind::bind_options<HtkFeatureOptions>(m, "How HTK computes parameters; defaults are HTK's.");
  bind_parameters(m);
  bind_features(m);
  bind_tables(m);
  bind_labels(m);
}
