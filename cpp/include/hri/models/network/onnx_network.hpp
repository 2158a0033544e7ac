// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Convolutional networks out of ONNX files: chains of Conv, LeakyRelu or Relu, Max with a constant,
// and MaxPool, over one channel of (frames, bands), with Reshape at their ends.
#pragma once

#include <cstdint>
#include <string>

#include "hri/core/export.hpp"
#include "hri/core/types.hpp"
#include "hri/models/network/conv_network.hpp"

namespace hri {

/// Throws IoError where the file cannot be read, and FormatError for bytes that are no ONNX, and
/// for anything that ConvNetwork cannot compute; both name the file, the latter the node.
HRI_API ConvNetwork read_onnx_network(const std::string& path);
/// The same from memory; `name` is what errors call it.
HRI_API ConvNetwork parse_onnx_network(Span<const std::uint8_t> bytes, const std::string& name);

}  // namespace hri
