// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Wavelet packets, streams of coefficients and noise reduction.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/arrays.hpp"
#include "core/options.hpp"
#include "hri/signal/shrinkage.hpp"
#include "hri/signal/stream/wavelet_stream.hpp"
#include "hri/signal/wavelet_packets.hpp"

namespace py = pybind11;
using hri_bind::as_matrix;
using hri_bind::as_span;
using hri_bind::to_array;

namespace {

// Contiguous and of one dtype: the overload is chosen by the dtype alone.
template <class T>
using Array = py::array_t<T, py::array::c_style>;
using Nodes = std::vector<std::pair<int, std::size_t>>;

template <class T>
hri::WaveletPackets<T> as_packets(const std::vector<Array<T>>& levels) {
  hri::WaveletPackets<T> packets;
  for (const auto& level : levels) packets.levels.emplace_back(as_matrix(level, "packets"));
  return packets;
}

template <class T>
void bind_packets(py::module_& m) {
  m.def(
      "wavelet_packets",
      [](const Array<T>& x, const std::string& wavelet, hri::Border border, int num_levels) {
        const auto samples = as_span(x, "x");
        hri::WaveletPackets<T> packets;
        {
          const py::gil_scoped_release release;
          packets = hri::wavelet_packets<T>(samples, hri::wavelet(wavelet), border, num_levels);
        }
        py::list levels;
        for (const auto& level : packets.levels) levels.append(to_array(level));
        return levels;
      },
      py::arg("x").noconvert(), py::arg("wavelet"), py::arg("border"), py::arg("num_levels"),
      "Nodes of all levels, the signal's first, in natural order.");
  m.def(
      "best_basis",
      [](const std::vector<Array<T>>& levels) {
        const hri::WaveletPackets<T> packets = as_packets<T>(levels);
        std::vector<hri::PacketNode> basis;
        {
          const py::gil_scoped_release release;
          basis = hri::best_basis(packets);
        }
        Nodes nodes;
        for (const hri::PacketNode& node : basis) nodes.emplace_back(node.level, node.index);
        return nodes;
      },
      py::arg("packets").noconvert(), "(level, index) of the nodes with the least entropy.");
  m.def(
      "reconstruct_packets",
      [](const std::vector<Array<T>>& levels, const Nodes& nodes, const std::string& wavelet,
         hri::Border border) {
        const hri::WaveletPackets<T> packets = as_packets<T>(levels);
        std::vector<hri::PacketNode> basis;
        for (const auto& [level, index] : nodes) basis.push_back({level, index});
        std::vector<T> x;
        {
          const py::gil_scoped_release release;
          x = hri::reconstruct<T>(packets, basis, hri::wavelet(wavelet), border);
        }
        return to_array(x);
      },
      py::arg("packets").noconvert(), py::arg("basis"), py::arg("wavelet"), py::arg("border"),
      "The signal from the nodes of a basis.");
}

// Hands back what one call made final, by bands.
template <class T>
class Collector {
 public:
  explicit Collector(int num_levels) : bands_(static_cast<std::size_t>(num_levels) + 1) {}
  void operator()(int band, hri::Span<const T> values) {
    auto& to = bands_[static_cast<std::size_t>(band)];
    to.insert(to.end(), values.begin(), values.end());
  }
  [[nodiscard]] py::list arrays() const {
    py::list out;
    for (const auto& band : bands_) out.append(to_array(band));
    return out;
  }

 private:
  std::vector<std::vector<T>> bands_;
};

template <class T>
void bind_wavelet_stream(py::module_& m, const char* name) {
  using Stream = hri::WaveletStream<T>;
  py::class_<Stream>(m, name, "The transform of a signal that arrives in pieces.")
      .def(py::init<const hri::WaveletStreamOptions&>(), py::arg("options"))
      .def(
          "push",
          [](Stream& stream, const Array<T>& x) {
            const auto samples = as_span(x, "samples");
            Collector<T> found(stream.num_levels());
            {
              const py::gil_scoped_release release;
              stream.push(samples, found);
            }
            return found.arrays();
          },
          py::arg("samples").noconvert(),
          "Coefficients that have become final: [approximation, coarsest detail, ..., finest].")
      .def(
          "finish",
          [](Stream& stream) {
            Collector<T> found(stream.num_levels());
            stream.finish(found);
            return found.arrays();
          },
          "The rest, as if zeros followed; then it starts anew.")
      .def("reset", &Stream::reset, "Forgets what was pushed.");
}

template <class T>
void bind_shrinkage(py::module_& m) {
  m.def(
      "denoise",
      [](const Array<T>& x, const hri::ShrinkageOptions& options) {
        const auto samples = as_span(x, "x");
        std::vector<T> y;
        {
          const py::gil_scoped_release release;
          y = hri::denoise<T>(samples, options);
        }
        return to_array(y);
      },
      py::arg("x").noconvert(), py::arg("options") = hri::ShrinkageOptions{},
      "The signal without its noise, of the same length.");
  m.def(
      "approximate",
      [](const Array<T>& x, const std::string& wavelet, hri::Border border, int num_levels) {
        const auto samples = as_span(x, "x");
        std::vector<T> y;
        {
          const py::gil_scoped_release release;
          y = hri::approximate<T>(samples, hri::wavelet(wavelet), border, num_levels);
        }
        return to_array(y);
      },
      py::arg("x").noconvert(), py::arg("wavelet"), py::arg("border"), py::arg("num_levels"),
      "The approximation of a level, as loud as the signal.");
  m.def(
      "noise_level",
      [](const Array<T>& details) { return hri::noise_level(as_span(details, "details")); },
      py::arg("details").noconvert(), "Standard deviation of noise, by the median of details.");
  m.def(
      "shrinkage_threshold",
      [](const Array<T>& details, double noise, std::size_t num_samples, hri::ThresholdRule rule) {
        return hri::shrinkage_threshold(as_span(details, "details"), noise, num_samples, rule);
      },
      py::arg("details").noconvert(), py::arg("noise"), py::arg("num_samples"), py::arg("rule"),
      "The threshold for the details of one level.");
  m.def(
      "shrink",
      [](const Array<T>& details, double threshold, hri::ThresholdShape shape) {
        const auto values = as_span(details, "details");
        std::vector<T> kept(values.begin(), values.end());
        hri::shrink(hri::Span<T>(kept), threshold, shape);
        return to_array(kept);
      },
      py::arg("details").noconvert(), py::arg("threshold"), py::arg("shape"),
      "Details with a threshold applied.");
}

void bind_wavelet_options(py::module_& m) {
  hri_bind::bind_options<hri::ShrinkageOptions>(m, "Noise reduction by wavelets.");
  hri_bind::bind_options<hri::WaveletStreamOptions>(m,
                                                    "What a stream of samples is transformed by.");
}

}  // namespace

// After bind_wavelets(), whose Border it uses.
void bind_wavelet_tools(py::module_& m) {
  bind_wavelet_options(m);
  bind_packets<float>(m);
  bind_packets<double>(m);
  m.def("frequency_order", &hri::frequency_order, py::arg("level"),
        "Natural indices of a level's nodes by rising frequency.");
  bind_wavelet_stream<float>(m, "WaveletStream32");
  bind_wavelet_stream<double>(m, "WaveletStream64");
  bind_shrinkage<float>(m);
  bind_shrinkage<double>(m);
}
