// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Vector quantisation: codebooks of whole frames and of their streams.
#include "hri/models/codebook/codebook.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <vector>

#include "core/options.hpp"
#include "hri/models/codebook/multi_stream_codebook.hpp"
#include "models/model_inputs.hpp"

namespace py = pybind11;
using hri_bind::as_matrix;
using hri_bind::bind_files;
using hri_bind::FloatArray;
using hri_bind::to_array;

namespace {

// Lets other threads run during long work. For some microseconds it would not pay: a thread that
// gives up the lock may wait some milliseconds until it has it again.
void release_for_long(Eigen::Index multiplications,
                      std::optional<py::gil_scoped_release>* release) {
  constexpr Eigen::Index kLong = 1 << 20;  // some dozen microseconds
  if (multiplications > kLong) release->emplace();
}

void bind_training(py::module_& m) {
  hri_bind::bind_options<hri::CodebookOptions>(m, "Options of Codebook.");

  using Report = hri::CodebookReport;
  py::class_<Report>(m, "CodebookReport",
                     "How the training of a codebook went: one entry an iteration of k-means.")
      .def(py::init<>())
      .def_readonly("sizes", &Report::sizes, "Codewords there were.")
      .def_readonly("distortions", &Report::distortions,
                    "Mean squared distance, before the centroids moved.")
      .def_readonly("converged", &Report::converged,
                    "False where the iteration limit ended the last size.");
}

void bind_one(py::module_& m) {
  py::class_<hri::Codebook> cls(m, "Codebook", "Vector quantiser (Linde, Buzo, Gray).");
  cls.def(py::init([](const FloatArray& centroids) {
            return hri::Codebook(hri::MatrixF(as_matrix(centroids, "centroids")));
          }),
          py::arg("centroids"));
  cls.def_static(
      "train_lbg",
      [](const FloatArray& rows, hri::CodebookOptions o, hri::CodebookReport* report) {
        const auto matrix = as_matrix(rows, "rows");
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return hri::Codebook::train_lbg(matrix, o, report);
      },
      py::arg("rows"), py::arg_v("options", hri::CodebookOptions(), "CodebookOptions()"),
      py::arg("report") = nullptr, "Grows a codebook from one codeword by splitting.");
  cls.def_static(
      "train_kmeans",
      [](const FloatArray& rows, const FloatArray& centroids, hri::CodebookOptions o,
         hri::CodebookReport* report) {
        const auto matrix = as_matrix(rows, "rows");
        const auto first = as_matrix(centroids, "centroids");
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return hri::Codebook::train_kmeans(matrix, first, o, report);
      },
      py::arg("rows"), py::arg("centroids"),
      py::arg_v("options", hri::CodebookOptions(), "CodebookOptions()"),
      py::arg("report") = nullptr, "k-means from given centroids.");
  cls.def(
      "quantise",
      [](const hri::Codebook& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        py::array_t<std::int32_t> symbols(matrix.rows());
        std::int32_t* out = symbols.mutable_data();
        {
          std::optional<py::gil_scoped_release> release;
          release_for_long(matrix.size() * self.size(), &release);
          self.quantise(matrix, out, 1);
        }
        return symbols;
      },
      py::arg("frames"), "The nearest codeword of every frame, int32, shape (num_frames,).");
  cls.def(
      "distortion",
      [](const hri::Codebook& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        const py::gil_scoped_release release;
        return self.distortion(matrix);
      },
      py::arg("frames"), "Mean squared distance of the frames to their codewords.");
  cls.def("__len__", &hri::Codebook::size);
  cls.def_property_readonly("size", &hri::Codebook::size);
  cls.def_property_readonly("dim", &hri::Codebook::dim, "Columns of the rows it takes.");
  cls.def_property_readonly(
      "centroids", [](const hri::Codebook& self) { return to_array(self.centroids()); },
      "Codewords, a row each.");
  bind_files(cls);
}

void bind_streams(py::module_& m) {
  using Book = hri::MultiStreamCodebook;
  py::class_<Book> cls(m, "MultiStreamCodebook",
                       "Codes consecutive groups of columns apart, each by its own Codebook.");
  cls.def(py::init<std::vector<hri::Codebook>>(), py::arg("streams"));
  cls.def_static(
      "train_lbg",
      [](const FloatArray& rows, const std::vector<int>& widths, hri::CodebookOptions o) {
        const auto matrix = as_matrix(rows, "rows");
        o.should_stop = hri_bind::interrupted;
        const py::gil_scoped_release release;
        return Book::train_lbg(matrix, widths, o);
      },
      py::arg("rows"), py::arg("widths"),
      py::arg_v("options", hri::CodebookOptions(), "CodebookOptions()"),
      "Grows a codebook for each stream; widths are columns a stream.\n\n"
      "Raises InvalidArgument for widths that do not add up to the columns of the rows.");
  cls.def(
      "quantise",
      [](const Book& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        py::array_t<std::int32_t> symbols(
            {matrix.rows(), static_cast<Eigen::Index>(self.num_streams())});
        const hri::Span<std::int32_t> out(symbols.mutable_data(),
                                          static_cast<std::size_t>(symbols.size()));
        {
          std::optional<py::gil_scoped_release> release;
          Eigen::Index size = 0;
          for (int s = 0; s < self.num_streams(); ++s)
            size += Eigen::Index{self.stream(s).size()} * self.stream(s).dim();
          release_for_long(matrix.rows() * size, &release);
          self.quantise(matrix, out);
        }
        return symbols;
      },
      py::arg("frames"), "The nearest codewords, int32, shape (num_frames, num_streams).");
  cls.def(
      "distortion",
      [](const Book& self, const FloatArray& frames) {
        const auto matrix = as_matrix(frames, "frames");
        const py::gil_scoped_release release;
        return self.distortion(matrix);
      },
      py::arg("frames"), "Mean squared distance of the frames to their codewords, all streams.");
  cls.def("__len__", &Book::num_streams);
  cls.def_property_readonly("num_streams", &Book::num_streams,
                            "Codebooks, one for each group of columns.");
  cls.def_property_readonly("dim", &Book::dim, "Columns of the rows it takes.");
  cls.def_property_readonly(
      "streams",
      [](const Book& self) {
        std::vector<hri::Codebook> streams;
        streams.reserve(static_cast<std::size_t>(self.num_streams()));
        for (int s = 0; s < self.num_streams(); ++s) streams.push_back(self.stream(s));
        return streams;
      },
      "The codebooks.");
  bind_files(cls);
}

}  // namespace

void bind_codebook(py::module_& m) {
  bind_training(m);
  bind_one(m);
  bind_streams(m);
}
