// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as an ONNX file; what is read as a network computes.
#include "fuzzing.hpp"
#include "hri/models/network/onnx_network.hpp"

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
