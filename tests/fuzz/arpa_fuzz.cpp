// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as an ARPA file. What is read is written and read again as it was.
#include "fuzzing.hpp"
#include "hri/language/ngram_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hri::fuzzing::expect_typed_errors([&] {
    const hri::NGramModel model = hri::NGramModel::parse({data, data + size}, "input");
    const std::string arpa = model.to_arpa();
    if (hri::NGramModel::parse(arpa, "again").to_arpa() != arpa) std::abort();
    const std::vector<int> history{model.start()};
    if (!(model.log_probability(history, model.end()) < 1e8)) std::abort();
  });
  return 0;
}
