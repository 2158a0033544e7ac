// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Listening allocates nothing, neither in silence nor when words begin and end.
#include "hri/signal/stream/endpointer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "allocations/allocation_counter.hpp"
#include "hri/core/random.hpp"

namespace hri {
namespace {

using namespace testing_data;

TEST(Endpointer, AllocatesNothingWhileItHears) {
  Random random(1);
  std::vector<float> audio(16000 * 20);
  for (std::size_t n = 0; n < audio.size(); ++n) {
    const bool sounds = n % 32000 >= 16000 && n % 32000 < 24000;
    audio[n] = static_cast<float>(0.01 * random.normal() +
                                  (sounds ? 0.5 * std::sin(0.1 * static_cast<double>(n)) : 0.0));
  }
  EndpointerOptions options;
  options.pause_ms = 80;
  Endpointer endpointer(16000, options);
  int num_ends = 0;
  int num_pauses = 0;
  EXPECT_EQ(allocations_of([&] {
              Span<const float> rest = audio;
              while (!rest.empty()) {
                Endpoint event;
                const std::size_t used = endpointer.consume(rest, &event);
                num_ends += event.kind == EndpointKind::speech_end ? 1 : 0;
                num_pauses += event.kind == EndpointKind::speech_pause ? 1 : 0;
                rest = rest.subspan(used, rest.size() - used);
              }
              while (endpointer.finish().kind != EndpointKind::none) {
              }
            }),
            0);
  EXPECT_EQ(num_ends, 10);
  EXPECT_EQ(num_pauses, 10);
}

}  // namespace
}  // namespace hri
