// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Outlines of hands, descriptors of their shape, and their way through a clip.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/features/hand/chain_code.hpp"
#include "hri/features/hand/contour.hpp"
#include "hri/features/hand/fourier_descriptor.hpp"
#include "hri/features/hand/hand_track.hpp"
#include "hri/features/hand/shape_moments.hpp"
#include "hri/features/hand/wavelet_descriptor.hpp"

namespace py = pybind11;
using hri_bind::as_image;
using hri_bind::ByteArray;
using hri_bind::IntArray;
using hri_bind::to_array;

namespace {

std::vector<hri::ContourPoint> as_contour(const IntArray& points) {
  hri_bind::require_dimensions(points, 2, "contour");
  hri::require(points.shape(1) == 2, "contour must have two columns, x and y");
  std::vector<hri::ContourPoint> contour;
  contour.reserve(static_cast<std::size_t>(points.shape(0)));
  const std::int32_t* data = points.data();
  for (py::ssize_t i = 0; i < points.shape(0); ++i)
    contour.push_back({data[2 * i], data[2 * i + 1]});
  return contour;
}

// compute(mask) without the GIL, for every computer that takes a mask.
template <class Computer>
py::array_t<float> compute_mask(const Computer& self, const ByteArray& mask) {
  const auto shape = as_image(mask, 1, "mask");
  hri::VectorF out(self.num_features());
  {
    const py::gil_scoped_release release;
    self.compute(shape, {out.data(), static_cast<std::size_t>(out.size())});
  }
  return to_array(out);
}

template <class Computer>
py::array_t<float> compute_contour(const Computer& self, const IntArray& points) {
  const auto contour = as_contour(points);
  hri::VectorF out(self.num_features());
  {
    const py::gil_scoped_release release;
    self.compute(hri::Span<const hri::ContourPoint>(contour),
                 {out.data(), static_cast<std::size_t>(out.size())});
  }
  return to_array(out);
}

template <class Computer>
void def_outline_computer(py::module_& m, const char* name, const char* doc) {
  using Options = std::decay_t<decltype(std::declval<const Computer&>().options())>;
  py::class_<Computer>(m, name, doc)
      .def(py::init<const Options&>(), py::arg("options") = Options{})
      .def_property_readonly("num_features", &Computer::num_features, "Columns of the features.")
      .def("compute", &compute_mask<Computer>, py::arg("mask"), "float32, of a mask.")
      .def("compute_contour", &compute_contour<Computer>, py::arg("contour"),
           "float32, of an outline as trace_contour gives it.");
}

py::dict moments_dict(const hri::ShapeMoments& s) {
  py::dict d;
  const auto put = [&d](const char* name, double value) { d[name] = value; };
  put("m00", s.m00), put("m10", s.m10), put("m01", s.m01), put("m20", s.m20), put("m11", s.m11);
  put("m02", s.m02), put("m30", s.m30), put("m21", s.m21), put("m12", s.m12), put("m03", s.m03);
  put("mu20", s.mu20), put("mu11", s.mu11), put("mu02", s.mu02), put("mu30", s.mu30);
  put("mu21", s.mu21), put("mu12", s.mu12), put("mu03", s.mu03), put("nu20", s.nu20);
  put("nu11", s.nu11), put("nu02", s.nu02), put("nu30", s.nu30), put("nu21", s.nu21);
  put("nu12", s.nu12), put("nu03", s.nu03);
  return d;
}

hri::ShapeMoments moments_of(const ByteArray& mask) {
  const auto shape = as_image(mask, 1, "mask");
  const py::gil_scoped_release release;
  return hri::shape_moments(shape);
}

void bind_outlines(py::module_& m) {
  m.def(
      "trace_contour",
      [](const ByteArray& mask) {
        const auto shape = as_image(mask, 1, "mask");
        std::vector<hri::ContourPoint> contour;
        {
          const py::gil_scoped_release release;
          hri::trace_contour(shape, &contour);
        }
        py::array_t<std::int32_t> out({static_cast<py::ssize_t>(contour.size()), py::ssize_t{2}});
        std::int32_t* to = out.mutable_data();
        for (const hri::ContourPoint& p : contour) {
          *to++ = p.x_px;
          *to++ = p.y_px;
        }
        return out;
      },
      py::arg("mask"),
      "Outer outline of the largest region, clockwise in image axes: int32, shape (num_points, 2), "
      "x and y.");
  m.def(
      "resample_contour",
      [](const IntArray& points, int num_points) {
        hri::require(num_points >= 1, "num_points must be at least 1");
        const auto contour = as_contour(points);
        const auto count = static_cast<std::size_t>(num_points);
        std::vector<float> xy(2 * count);
        hri::resample_contour(contour, {xy.data(), count}, {xy.data() + count, count});
        hri::MatrixF out(num_points, 2);
        for (std::size_t i = 0; i < count; ++i) {
          out(static_cast<Eigen::Index>(i), 0) = xy[i];
          out(static_cast<Eigen::Index>(i), 1) = xy[count + i];
        }
        return to_array(out);
      },
      py::arg("contour"), py::arg("num_points"),
      "Points at equal distances along the smoothed outline: float32, shape (num_points, 2).");
  m.def(
      "chain_code",
      [](const IntArray& points) {
        std::vector<std::uint8_t> code;
        hri::chain_code(as_contour(points), &code);
        return to_array(code);
      },
      py::arg("contour"), "Freeman's directions, uint8: 0 right, 2 up, 4 left, 6 down.");
  m.def(
      "shape_number",
      [](const IntArray& points) { return to_array(hri::shape_number(as_contour(points))); },
      py::arg("contour"), "Turns of the outline from their least start on, uint8.");
}

void bind_descriptors(py::module_& m) {
  hri_bind::bind_options<hri::ChainCodeOptions>(m, "Histograms of chain codes.");
  def_outline_computer<hri::ChainCodeComputer>(m, "ChainCodeComputer",
                                               "Histograms of the directions of an outline.");

  hri_bind::bind_options<hri::FourierDescriptorOptions>(m, "Harmonics of an outline.");
  def_outline_computer<hri::FourierDescriptorComputer>(m, "FourierDescriptorComputer",
                                                       "Fourier descriptors of an outline.");

  hri_bind::bind_options<hri::WaveletDescriptorOptions>(m, "Moment-invariant wavelet descriptors.");
  py::class_<hri::WaveletDescriptorComputer>(m, "WaveletDescriptorComputer",
                                             "Moment-invariant wavelet descriptors of a mask.")
      .def(py::init<const hri::WaveletDescriptorOptions&>(),
           py::arg("options") = hri::WaveletDescriptorOptions{})
      .def_property_readonly("num_features", &hri::WaveletDescriptorComputer::num_features,
                             "Columns of the features.")
      .def("compute", &compute_mask<hri::WaveletDescriptorComputer>, py::arg("mask"),
           "float32, by frequency, scale and place.");
  m.def("b_spline_wavelet", &hri::b_spline_wavelet, py::arg("r"),
        "The wavelet along the radius (thesis eq. 3.22).");
}

void bind_moments(py::module_& m) {
  m.def(
      "shape_moments", [](const ByteArray& mask) { return moments_dict(moments_of(mask)); },
      py::arg("mask"), "Moments to the third order, named as OpenCV names them.");
  m.def(
      "shape_axis",
      [](const ByteArray& mask) {
        const hri::ShapeAxis axis = hri::shape_axis(moments_of(mask));
        return std::make_pair(axis.angle_rad, axis.elongation);
      },
      py::arg("mask"),
      "Angle of the longer axis from x towards y (down), and elongation, 0 (round) to 1 (a line).");
  m.def(
      "hu_moments",
      [](const ByteArray& mask) {
        hri::VectorD out(hri::kNumHuMoments);
        hri::hu_moments(moments_of(mask), {out.data(), static_cast<std::size_t>(out.size())});
        return to_array(out);
      },
      py::arg("mask"), "Hu's seven invariants, float64.");
  m.def(
      "hu_features",
      [](const ByteArray& mask) {
        const auto shape = as_image(mask, 1, "mask");
        hri::VectorF out(hri::kNumHuMoments);
        {
          const py::gil_scoped_release release;
          hri::hu_features(shape, {out.data(), static_cast<std::size_t>(out.size())});
        }
        return to_array(out);
      },
      py::arg("mask"), "The root of each of Hu's invariants by its degree, float32.");
}

void bind_tracks(py::module_& m) {
  hri_bind::bind_options<hri::HandTrackOptions>(m, "The way of a hand.");
  py::class_<hri::HandTrackComputer>(m, "HandTrackComputer",
                                     "Place, size, axis and speed of a hand, with deltas.")
      .def(py::init<const hri::HandTrackOptions&>(), py::arg("options") = hri::HandTrackOptions{})
      .def_property_readonly("num_features", &hri::HandTrackComputer::num_features,
                             "Columns of the features.")
      .def(
          "compute",
          [](const hri::HandTrackComputer& self, const std::vector<ByteArray>& masks) {
            std::vector<hri::ImageView> views;
            views.reserve(masks.size());
            for (const ByteArray& mask : masks) views.push_back(as_image(mask, 1, "masks"));
            hri::MatrixF out;
            {
              const py::gil_scoped_release release;
              out = self.compute(views);
            }
            return to_array(out);
          },
          py::arg("masks"), "float32, a row for every mask that shows a hand.");
  py::list columns;
  for (const char* name : hri::kHandTrackColumns) columns.append(name);
  m.attr("HAND_TRACK_COLUMNS") = py::tuple(columns);
}

}  // namespace

void bind_hand_shapes(py::module_& m) {
  bind_outlines(m);
  bind_descriptors(m);
  bind_moments(m);
  bind_tracks(m);
}
