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
  py::class_<hri::OrientationHistogramOptions> histogram(m, "OrientationHistogramOptions",
                                                         "Grid of cells and bins.");
  hri_bind::options(histogram)
      .field("num_cells", &hri::OrientationHistogramOptions::num_cells)
      .field("num_bins", &hri::OrientationHistogramOptions::num_bins);
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
      "Block-normalised histograms, float32.");

  py::class_<hri::SilhouetteCepstrumOptions> cepstrum(m, "SilhouetteCepstrumOptions",
                                                      "DWT + MFCC of a silhouette.");
  hri_bind::options(cepstrum)
      .field("wavelet", &hri::SilhouetteCepstrumOptions::wavelet)
      .field("num_levels", &hri::SilhouetteCepstrumOptions::num_levels)
      .field("mask_px", &hri::SilhouetteCepstrumOptions::mask_px)
      .field("num_points", &hri::SilhouetteCepstrumOptions::num_points)
      .field("num_filters", &hri::SilhouetteCepstrumOptions::num_filters)
      .field("num_cepstra", &hri::SilhouetteCepstrumOptions::num_cepstra);
  py::class_<hri::SilhouetteCepstrumComputer>(m, "SilhouetteCepstrumComputer",
                                              "Cepstrum of a silhouette's contour.")
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
          py::arg("mask"), "c0, c1, ..., float32.");

  py::class_<hri::HandFeatureOptions> options(m, "HandFeatureOptions",
                                              "The joined feature of one hand picture.");
  hri_bind::options(options)
      .field("crop_px", &hri::HandFeatureOptions::crop_px)
      .field("histogram", &hri::HandFeatureOptions::histogram)
      .field("use_grey", &hri::HandFeatureOptions::use_grey)
      .field("use_silhouette", &hri::HandFeatureOptions::use_silhouette)
      .field("use_cepstrum", &hri::HandFeatureOptions::use_cepstrum)
      .field("cepstrum", &hri::HandFeatureOptions::cepstrum)
      .field("cepstrum_weight", &hri::HandFeatureOptions::cepstrum_weight)
      .field("use_wavelet", &hri::HandFeatureOptions::use_wavelet)
      .field("wavelet", &hri::HandFeatureOptions::wavelet)
      .field("use_moments", &hri::HandFeatureOptions::use_moments)
      .field("use_fourier", &hri::HandFeatureOptions::use_fourier)
      .field("fourier", &hri::HandFeatureOptions::fourier)
      .field("use_chain_code", &hri::HandFeatureOptions::use_chain_code)
      .field("chain_code", &hri::HandFeatureOptions::chain_code)
      .field("descriptor_weight", &hri::HandFeatureOptions::descriptor_weight);
  py::class_<hri::HandFeatureComputer>(m, "HandFeatureComputer", "Features of one hand picture.")
      .def(py::init<const hri::HandFeatureOptions&>(),
           py::arg("options") = hri::HandFeatureOptions{})
      .def_property_readonly("num_features", &hri::HandFeatureComputer::num_features)
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
