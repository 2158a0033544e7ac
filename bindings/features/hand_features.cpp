// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Features of hands, from plain grey and mask images.
#include "hri/features/hand/hand_features.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/features/hand/hand_crop.hpp"

namespace py = pybind11;
using hri_bind::as_image;
using hri_bind::ByteArray;
using hri_bind::to_array;

void bind_hand_features(py::module_& m) {
  hri_bind::bind_options<hri::OrientationHistogramOptions>(m, "Grid of cells and bins.");
  m.def(
      "orientation_histogram",
      [](const hri_bind::FloatArray& image, const hri::OrientationHistogramOptions& options) {
        const auto values = hri_bind::as_matrix(image, "image");
        hri::VectorF out(hri::orientation_histogram_size(options));
        {
          const py::gil_scoped_release release;
          hri::orientation_histogram(values, options,
                                     {out.data(), static_cast<std::size_t>(out.size())});
        }
        return to_array(out);
      },
      py::arg("image"), py::arg("options") = hri::OrientationHistogramOptions{},
      "Histograms, float32; of several cells normalised by blocks, of one by its length.");

  hri_bind::bind_options<hri::SilhouetteCepstrumOptions>(
      m, "DWT + MFCC of a silhouette: contour or picture.");
  py::class_<hri::SilhouetteCepstrumComputer>(m, "SilhouetteCepstrumComputer",
                                              "Cepstra of a silhouette.")
      .def_property_readonly("num_features", &hri::SilhouetteCepstrumComputer::num_features,
                             "Values of compute().")
      .def(py::init<const hri::SilhouetteCepstrumOptions&>(),
           py::arg("options") = hri::SilhouetteCepstrumOptions{})
      .def(
          "contour_signal",
          [](const hri::SilhouetteCepstrumComputer& self, const ByteArray& mask) {
            const auto shape = as_image(mask, 1, "mask");
            std::vector<float> signal;
            {
              const py::gil_scoped_release release;
              signal = self.contour_signal(shape);
            }
            return to_array(signal);
          },
          py::arg("mask"), "Distance from the centroid along the contour, scaled by its mean.")
      .def(
          "picture_signal",
          [](const hri::SilhouetteCepstrumComputer& self, const ByteArray& mask) {
            const auto shape = as_image(mask, 1, "mask");
            std::vector<float> signal;
            {
              const py::gil_scoped_release release;
              signal = self.picture_signal(shape);
            }
            return to_array(signal);
          },
          py::arg("mask"),
          "Pixels of the DWT's approximation, column by column, divided by its gain of 2 a level.")
      .def(
          "compute",
          [](const hri::SilhouetteCepstrumComputer& self, const ByteArray& mask) {
            const auto shape = as_image(mask, 1, "mask");
            hri::VectorF out(self.num_features());
            {
              const py::gil_scoped_release release;
              self.compute(shape, {out.data(), static_cast<std::size_t>(out.size())});
            }
            return to_array(out);
          },
          py::arg("mask"), "c0, c1, ..., averaged over the frames or frame by frame, float32.");

  hri_bind::bind_options<hri::HandFeatureOptions>(m,
                                                  "The concatenated features of one hand picture.");
  py::class_<hri::HandFeatureComputer>(m, "HandFeatureComputer", "Features of one hand picture.")
      .def(py::init<const hri::HandFeatureOptions&>(),
           py::arg("options") = hri::HandFeatureOptions{})
      .def_property_readonly("num_features", &hri::HandFeatureComputer::num_features,
                             "Columns of the features.")
      .def(
          "compute",
          [](const hri::HandFeatureComputer& self, const ByteArray& grey, const ByteArray& mask) {
            const auto g = as_image(grey, 1, "grey");
            const auto k = as_image(mask, 1, "mask");
            hri::VectorF out;
            {
              const py::gil_scoped_release release;
              out = self.compute(g, k);
            }
            return to_array(out);
          },
          py::arg("grey"), py::arg("mask"),
          "float32, shape (num_features,); mask is 0 or 255, uint8.");
}
