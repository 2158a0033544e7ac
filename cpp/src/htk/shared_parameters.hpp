// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// The parameters of a model set, each once however many definitions use its macro.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hri/htk/model_set.hpp"

namespace hri::htk::detail {

/// Numbers stand for places in the vectors of SharedParameters.
struct SharedComponent {
  int mean = 0;
  int variance = 0;
};

struct SharedState {
  std::vector<int> components;  ///< none of a discrete state
  std::vector<double> weights;  ///< of these, or the probabilities of codewords
};

struct SharedHmm {
  std::string name;
  std::vector<int> states;
  int transitions = 0;
};

class SharedParameters {
 public:
  /// Throws InvalidArgument for a set whose macros are used with several values or sizes.
  explicit SharedParameters(const ModelSet& set);

  std::vector<VectorD> means;
  std::vector<VectorD> variances;
  std::vector<SharedComponent> components;
  std::vector<SharedState> states;
  std::vector<MatrixD> transitions;
  std::vector<SharedHmm> hmms;

  /// The place of an HMM; -1 where there is none.
  [[nodiscard]] int find(const std::string& hmm) const;

  /// Throws InvalidArgument naming row and column for values not finite, and where the models are
  /// discrete for those that are no codeword, a whole number from 1. `what`: of the frames.
  void require_frames(ConstMatrixRefF frames, const std::string& what) const;

  /// The set that this was made of, with these values; constants of the Gaussians are computed.
  [[nodiscard]] ModelSet applied_to(ModelSet set) const;

 private:
  // The place of what is defined under this name, or used by it, and whether it is a new one.
  std::pair<int, bool> place(char type, const std::string& macro, std::size_t next);
  int add(char type, const std::string& macro, const VectorD& values, std::vector<VectorD>* all);
  int add(const std::string& macro, const ComponentDefinition& definition);
  int add(const std::string& macro, const StateDefinition& definition);
  int add(const std::string& macro, const TransitionDefinition& definition);

  void put(int number, ComponentDefinition* definition) const;
  void put(int number, StateDefinition* definition) const;

  std::map<std::string, int> places_;
  std::map<std::string, int> hmm_places_;
  std::vector<int> numbers_;  // of the definitions of the set, among their type
};

/// The least variances that a set has for its training, ~v "varFloor1", but at least `smallest`
/// each. Throws InvalidArgument for another number of values than the vectors of the set have.
VectorD variance_floor(const ModelSet& set, double smallest);

}  // namespace hri::htk::detail
