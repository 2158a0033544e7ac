// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as an ONNX file; what is read as a network computes.
#include <algorithm>
#include <random>

#include "fuzzing.hpp"
#include "hri/models/network/onnx_network.hpp"

extern "C" size_t LLVMFuzzerMutate(std::uint8_t* data, size_t size, size_t max_size);

// Most changes keep the number of bytes: fields say how long they are, and those about them, too.
extern "C" size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t max_size,
                                          unsigned seed) {
  std::mt19937 random(seed);
  if (size == 0 || random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  for (unsigned i = 0; i <= random() % 4; ++i) {
    const std::size_t at = random() % size;
    const std::size_t count = std::min<std::size_t>(1 + random() % 4, size - at);
    static_cast<void>(LLVMFuzzerMutate(data + at, count, count));
  }
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hri::fuzzing::expect_typed_errors([&] {
    const hri::ConvNetwork network = hri::parse_onnx_network({data, size}, "input");
    if (network.num_outputs() < 1 || network.window_frames() < 1) std::abort();
    const long frames = network.window_frames() + network.step_frames();
    if (frames * network.num_bands() > 10000) return;
    const hri::MatrixF rows = network.compute(hri::MatrixF::Ones(frames, network.num_bands()));
    if (rows.rows() != 2 || rows.cols() != network.num_outputs()) std::abort();
  });
  return 0;
}
