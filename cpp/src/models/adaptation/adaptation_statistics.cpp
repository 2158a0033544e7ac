// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "models/adaptation/adaptation_statistics.hpp"

#include <cmath>
#include <string>

#include "hri/core/error.hpp"
#include "models/hmm/forward_backward.hpp"

namespace hri::detail {

void check_adaptation_data(const std::vector<MatrixF>& sequences, int dim) {
  if (sequences.empty()) return;
  const GlobalStatistics global = global_statistics(sequences);  // names what is not finite
  if (global.mean.size() != dim) {
    fail(ErrorKind::invalid_argument, "the sequences have " + std::to_string(global.mean.size()) +
                                          " columns, the model has " + std::to_string(dim));
  }
}

void add_aligned(const MarkovChain& chain, const MixtureBank& bank,
                 const std::vector<MatrixF>& sequences, const StopCheck& should_stop,
                 MixtureAccumulator* accumulator) {
  MatrixD densities;
  MatrixD shares;
  MatrixD gamma;
  for (const MatrixF& frames : sequences) {
    poll(should_stop);
    bank.log_densities(frames, &densities, &shares);
    gamma.resize(frames.rows(), bank.num_states());
    const double total =
        forward_backward(chain, rows_of(densities), gamma.data(), bank.num_states(), nullptr);
    if (std::isfinite(total)) accumulator->add(frames, gamma, shares);
  }
}

}  // namespace hri::detail
