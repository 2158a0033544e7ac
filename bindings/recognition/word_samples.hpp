// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Recordings of words from lists of arrays.
#pragma once

#include <string>
#include <vector>

#include "core/arrays.hpp"
#include "hri/core/error.hpp"
#include "hri/recognition/word/word_recognizer.hpp"

namespace hri_bind {

/// The samples are not copied. `groups` may be empty. Errors name recording i as "list[i]", after
/// the caller's own argument.
inline std::vector<hri::WordSample> as_word_samples(const std::vector<FloatArray>& samples,
                                                    const std::vector<int>& sample_rates_hz,
                                                    const std::vector<std::string>& labels,
                                                    const std::vector<std::string>& groups,
                                                    const std::string& list) {
  const bool fits = samples.size() == labels.size() && samples.size() == sample_rates_hz.size() &&
                    (groups.empty() || samples.size() == groups.size());
  if (!fits) {
    hri::fail(hri::ErrorKind::invalid_argument,
              list + ", sample_rate_hz, labels and groups differ in length");
  }
  std::vector<hri::WordSample> words;
  words.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string name = list + "[" + std::to_string(i) + "]";
    words.push_back({as_span(samples[i], name.c_str()), sample_rates_hz[i], labels[i],
                     groups.empty() ? "" : groups[i], name});
  }
  return words;
}

}  // namespace hri_bind
