// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Files: whole ones in and out, model files, WAV files.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/paths.hpp"
#include "hri/io/file.hpp"
#include "hri/io/model_file.hpp"
#include "hri/io/video_container.hpp"
#include "hri/io/wav.hpp"

namespace py = pybind11;

namespace {

hri::Span<const std::uint8_t> as_bytes(const py::bytes& data) {
  const std::string_view view(data);
  return {reinterpret_cast<const std::uint8_t*>(view.data()), view.size()};
}

void bind_whole_files(py::module_& m) {
  py::class_<hri::AtomicFile>(m, "AtomicFile",
                              "A file that appears whole or not at all, written beside its place.")
      .def(py::init([](const hri_bind::Path& path) {
             const py::gil_scoped_release release;
             return std::make_unique<hri::AtomicFile>(path.text);
           }),
           py::arg("path"), "Raises IoError where it could not be written.")
      .def_property_readonly(
          "temporary_path",
          [](const hri::AtomicFile& self) {
            const std::string& path = self.temporary_path();
            return py::reinterpret_steal<py::str>(PyUnicode_DecodeFSDefaultAndSize(
                path.data(), static_cast<py::ssize_t>(path.size())));
          },
          "Where it is until then; with the suffix of its place.")
      .def(
          "write",
          [](hri::AtomicFile& self, const py::bytes& data) {
            const auto bytes = as_bytes(data);
            const py::gil_scoped_release release;
            self.write(bytes);
          },
          py::arg("data"), "Appends; raises IoError.")
      .def("commit", &hri::AtomicFile::commit, py::call_guard<py::gil_scoped_release>(),
           "Syncs it to the disk and gives it its name; raises IoError.")
      .def("discard", &hri::AtomicFile::discard, py::call_guard<py::gil_scoped_release>(),
           "Leaves nothing behind; after `commit` this does nothing.");
  m.def(
      "read_file",
      [](const hri_bind::Path& path, std::uint64_t max_bytes) {
        const std::vector<std::uint8_t> data = [&] {
          const py::gil_scoped_release release;
          return hri::read_file(path.text, max_bytes);
        }();
        return py::bytes(reinterpret_cast<const char*>(data.data()), data.size());
      },
      py::arg("path"), py::arg("max_bytes"),
      "The bytes of a regular file; raises IoError, and FormatError for a larger one.");
  m.def(
      "require_whole_video",
      [](const hri_bind::Path& path) {
        const py::gil_scoped_release release;
        hri::require_whole_video(path.text);
      },
      py::arg("path"), "Raises FormatError for a video that is shorter than it says, and IoError.");
}

}  // namespace

void bind_files(py::module_& m) {
  bind_whole_files(m);
  py::class_<hri::ModelFile>(m, "ModelFile",
                             "Tensors and metadata in the safetensors layout; strict reader.")
      .def(py::init<>())
      .def_static(
          "read", [](const hri_bind::Path& path) { return hri::ModelFile::read(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>(),
          "Reads a whole file; raises IoError, or FormatError naming file and field.")
      .def(
          "write",
          [](const hri::ModelFile& self, const hri_bind::Path& path) { self.write(path.text); },
          py::arg("path"), py::call_guard<py::gil_scoped_release>(),
          "Writes beside the old file, syncs, and renames.")
      .def_static(
          "from_bytes",
          [](const py::bytes& data, const std::string& name) {
            const auto bytes = as_bytes(data);
            const py::gil_scoped_release release;
            return hri::ModelFile::parse(bytes, name);
          },
          py::arg("data"), py::arg("name") = "bytes", "Reads what `to_bytes` gave, as strictly.")
      .def(
          "to_bytes",
          [](const hri::ModelFile& self) {
            const std::vector<std::uint8_t> data = self.serialise();
            return py::bytes(reinterpret_cast<const char*>(data.data()), data.size());
          },
          "What `write` writes.")
      .def_property("kind", &hri::ModelFile::kind, &hri::ModelFile::set_kind,
                    "What it holds, such as 'word_recognizer'.")
      .def("has", &hri::ModelFile::has, py::arg("name"),
           "Whether there is a tensor or metadata of that name.")
      .def("text", &hri::ModelFile::text, py::arg("key"),
           "Metadata; raises FormatError without it.")
      .def("integer", &hri::ModelFile::integer, py::arg("key"), "Metadata as a whole number.")
      .def("number", &hri::ModelFile::number, py::arg("key"), "Metadata as a finite number.")
      .def("text_list", &hri::ModelFile::text_list, py::arg("key"), "Metadata as a list of texts.")
      .def("set_text", &hri::ModelFile::set_text, py::arg("key"), py::arg("value"),
           "Set metadata, UTF-8.")
      .def("set_integer", &hri::ModelFile::set_integer, py::arg("key"), py::arg("value"),
           "Set metadata to a whole number.")
      .def("set_number", &hri::ModelFile::set_number, py::arg("key"), py::arg("value"),
           "Set metadata to a finite number.")
      .def("set_text_list", &hri::ModelFile::set_text_list, py::arg("key"), py::arg("values"),
           "Set metadata to a list of texts.")
      .def("metadata", &hri::ModelFile::metadata, "All metadata as a dict of text.")
      .def("require_all_read", &hri::ModelFile::require_all_read,
           "Raises FormatError that names a field or tensor which nothing has asked for.")
      .def("tensor_shapes", &hri::ModelFile::tensor_shapes, "Name to (rows, columns).")
      .def(
          "matrix_d",
          [](const hri::ModelFile& self, const std::string& name) {
            return hri_bind::to_array(self.matrix_d(name));
          },
          py::arg("name"), "A tensor as float64, shape (rows, columns).")
      .def(
          "matrix_f",
          [](const hri::ModelFile& self, const std::string& name) {
            return hri_bind::to_array(self.matrix_f(name));
          },
          py::arg("name"), "A tensor as float32, shape (rows, columns).")
      .def(
          "set_matrix_d",
          [](hri::ModelFile& self, const std::string& name, const hri_bind::DoubleArray& values) {
            self.set_matrix(name, hri::ConstMatrixRefD(hri_bind::as_matrix(values, "values")));
          },
          py::arg("name"), py::arg("values"), "Set a tensor of float64.")
      .def(
          "set_matrix_f",
          [](hri::ModelFile& self, const std::string& name, const hri_bind::FloatArray& values) {
            self.set_matrix(name, hri::ConstMatrixRefF(hri_bind::as_matrix(values, "values")));
          },
          py::arg("name"), py::arg("values"), "Set a tensor of float32.");

  py::class_<hri::Wav>(m, "Wav", "Mono samples of a WAV file.")
      .def_property_readonly(
          "samples", [](const hri::Wav& self) { return hri_bind::to_array(self.samples); },
          "float32, shape (num_samples,), full scale 1.")
      .def_readonly("sample_rate_hz", &hri::Wav::sample_rate_hz, "Samples a second.")
      .def_readonly("num_channels", &hri::Wav::num_channels,
                    "Channels of the file; they are averaged.")
      .def_readonly("notes", &hri::Wav::notes, "What was done to the audio on reading.");
  m.def(
      "read_wav", [](const hri_bind::Path& path) { return hri::read_wav(path.text); },
      py::arg("path"), py::call_guard<py::gil_scoped_release>(),
      "Reads PCM or float WAV, averaged to mono; raises FormatError naming file and field.");
  m.def(
      "parse_wav",
      [](const py::bytes& data, const std::string& name) {
        const auto bytes = as_bytes(data);
        const py::gil_scoped_release release;
        return hri::parse_wav(bytes, name);
      },
      py::arg("data"), py::arg("name") = "bytes");
  m.def(
      "write_wav_pcm16",
      [](const hri_bind::Path& path, const hri_bind::FloatArray& samples, int sample_rate_hz) {
        const auto x = hri_bind::as_span(samples, "samples");
        const py::gil_scoped_release release;
        hri::write_wav_pcm16(path.text, x, sample_rate_hz);
      },
      py::arg("path"), py::arg("samples"), py::arg("sample_rate_hz"));
}
