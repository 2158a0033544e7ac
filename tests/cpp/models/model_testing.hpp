// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Data and helpers of the models' tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hri/core/random.hpp"
#include "hri/core/types.hpp"
#include "hri/io/model_file.hpp"

namespace hri::testing_data {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The message of the `Failure` that `action` throws, or "nothing thrown".
template <class Failure, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "nothing thrown";
}

struct LabelledRows {
  MatrixF rows;
  std::vector<int> classes;
};

/// `per_class` rows around `num_classes` centres on a circle of radius `radius`, deviation 1, extra
/// columns of noise.
inline LabelledRows blobs(int num_classes, int per_class, double radius, std::uint64_t seed,
                          int dim = 3) {
  Random random(seed);
  LabelledRows data{MatrixF(num_classes * per_class, dim), {}};
  for (int r = 0; r < num_classes * per_class; ++r) {
    const int c = r % num_classes;
    const double angle = 6.283185307179586 * c / num_classes;
    for (int d = 0; d < dim; ++d) data.rows(r, d) = static_cast<float>(random.normal());
    data.rows(r, 0) += static_cast<float>(radius * std::cos(angle));
    data.rows(r, 1) += static_cast<float>(radius * std::sin(angle));
    data.classes.push_back(c);
  }
  return data;
}

inline MatrixF noise(Eigen::Index num_rows, Eigen::Index dim, std::uint64_t seed,
                     double offset = 0) {
  Random random(seed);
  MatrixF rows(num_rows, dim);
  for (Eigen::Index i = 0; i < rows.size(); ++i)
    rows.data()[i] = static_cast<float>(random.normal() + offset);
  return rows;
}

/// What a model file gives back after a trip through bytes.
inline ModelFile through_bytes(const ModelFile& file) {
  const std::vector<std::uint8_t> bytes = file.serialise();
  return ModelFile::parse(bytes, "round trip");
}

inline int argmax(const VectorF& values) {
  Eigen::Index best = 0;
  values.maxCoeff(&best);
  return static_cast<int>(best);
}

}  // namespace hri::testing_data
