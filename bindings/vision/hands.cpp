// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Hands in clips and streams.
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/arrays.hpp"
#include "hri/core/error.hpp"
#include "hri/vision/hand_finder.hpp"
#include "vision/clips.hpp"

namespace py = pybind11;

namespace {

using hri_bind::as_clip;
using hri_bind::ByteArray;

hri::FrameProgress with_gil(const std::function<void(int, int)>& progress) {
  if (!progress) return {};
  return [&progress](int done, int total) {
    const py::gil_scoped_acquire gil;
    progress(done, total);
  };
}

}  // namespace

void bind_vision_hands(py::module_& m) {
  m.attr("HandFinderOptions") = py::module_::import("hri._native").attr("HandFinderOptions");
  py::class_<hri::HandStream>(m, "HandStream", "The hand in one stream of pictures.")
      .def(
          "push",
          [](hri::HandStream& self, const ByteArray& bgr, double time_s, bool in_gesture) {
            const auto picture = hri_bind::as_image(bgr, 3, "picture");
            const py::gil_scoped_release release;
            return self.push(picture, time_s, in_gesture);
          },
          py::arg("bgr"), py::arg("time_s"), py::arg("in_gesture") = false,
          "The HandObservation of the next picture.")
      .def_property_readonly("renewed", &hri::HandStream::renewed,
                             "Hands are found in another way since the last picture.");
  py::class_<hri::HandFinder>(m, "HandFinder", "Finds hands in clips and streams.")
      .def(py::init([](const hri::HandFinderOptions& options,
                       const std::optional<ByteArray>& background,
                       const std::optional<std::shared_ptr<hri::FaceFinder>>& faces,
                       const hri::PersonOptions& person) {
             hri::require(!background || !faces, "either background or faces may be given");
             if (faces) return hri::HandFinder(options, *faces, person);
             return background
                        ? hri::HandFinder(options, hri_bind::as_image(*background, 3, "background"))
                        : hri::HandFinder(options);
           }),
           py::arg("options") = hri::HandFinderOptions{}, py::arg("background") = py::none(),
           py::arg("faces") = py::none(), py::arg("person") = hri::PersonOptions{},
           "background: uint8, shape (height, width, 3), the place without a person. faces: where "
           "one is seen, hands are found as that person's.")
      .def(
          "find",
          [](const hri::HandFinder& self, const std::vector<ByteArray>& clip,
             const std::function<void(int, int)>& progress) {
            const auto views = as_clip(clip);
            const auto report = with_gil(progress);
            const py::gil_scoped_release release;
            return self.find(views, report);
          },
          py::arg("clip"), py::arg("progress") = nullptr, "A HandObservation for every frame.")
      .def(
          "find_pair",
          [](const hri::HandFinder& self, const std::vector<ByteArray>& clip,
             const std::function<void(int, int)>& progress) {
            const auto views = as_clip(clip);
            const auto report = with_gil(progress);
            const py::gil_scoped_release release;
            return self.find_pair(views, report);
          },
          py::arg("clip"), py::arg("progress") = nullptr,
          "The observations of the left hand of the picture, and those of the right one.")
      .def(
          "stream",
          [](const hri::HandFinder& self, bool dynamic, int max_hands) {
            return self.stream(dynamic, max_hands);
          },
          py::arg("dynamic") = true, py::arg("max_hands") = 1,
          "A HandStream of its own, of masks of one hand or both; `dynamic`: by colours learned "
          "from the stream.")
      .def_property_readonly("options", &hri::HandFinder::options,
                             "As passed, with defaults filled in.");
  m.def(
      "background_of",
      [](const std::vector<ByteArray>& clip) {
        const auto views = as_clip(clip);
        std::vector<std::uint8_t> pixels;
        {
          const py::gil_scoped_release release;
          pixels = hri::background_of(views);
        }
        py::array_t<std::uint8_t> out({views[0].height_px, views[0].width_px, 3});
        std::copy(pixels.begin(), pixels.end(), out.mutable_data());
        return out;
      },
      py::arg("clip"), "Every pixel's median over up to 25 frames spread over the clip.");
}
