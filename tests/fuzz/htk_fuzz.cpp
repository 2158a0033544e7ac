// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as one of HTK's files; the first byte chooses which, '0' the first. What is read is
// written and read again as it was.
#include "fuzzing.hpp"
#include "hri/htk/configuration.hpp"
#include "hri/htk/edit_script.hpp"
#include "hri/htk/labels.hpp"
#include "hri/htk/recognizer.hpp"
#include "hri/htk/vq_table.hpp"
#include "htk/state_tying.hpp"

namespace {

template <class File>
void check_text(const File& file) {
  const std::string text = file.to_text();
  if (File::parse(text, "again").to_text() != text) std::abort();
}

void read_parameters(const std::uint8_t* data, std::size_t size) {
  const auto file = hri::htk::ParameterFile::parse({data, size}, "input");
  const std::vector<std::uint8_t> bytes = file.serialise();
  const auto again = hri::htk::ParameterFile::parse(bytes, "again");
  if (again.values.rows() != file.values.rows() || again.serialise().size() != bytes.size())
    std::abort();
}

// Frames of a file, which the first byte chooses, without and with the others.
void read_frames(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  const std::int64_t first = data[0] & 0xf;
  const hri::Span<const std::uint8_t> bytes{data + 1, size - 1};
  const auto part = hri::htk::ParameterFile::parse_frames(bytes, "input", first,
                                                          first + std::int64_t{data[0] >> 4U} + 1);
  const auto header = hri::htk::ParameterHeader::parse(bytes, "input");
  if (part.values.cols() != header.num_columns || first + part.values.rows() > header.num_frames)
    std::abort();
  const auto file = hri::htk::ParameterFile::parse(bytes, "input");
  if (part.values != file.values.middleRows(first, part.values.rows())) std::abort();
}

// Written again as it was read; in the form of this library once it is changed.
void read_lattice(const std::string& text) {
  auto lattice = hri::htk::WordLattice::parse(text, "input");
  if (lattice.to_text() != text) std::abort();
  lattice.language_scale += 1;
  const std::string written = lattice.to_text();
  auto again = hri::htk::WordLattice::parse(written, "again");
  again.language_scale += 1;
  lattice.language_scale += 1;
  if (again.to_text() != lattice.to_text()) std::abort();
}

void read_models(const std::string& text) {
  hri::htk::ModelSet set;
  set.parse(text, "input");
  const std::string written = set.to_text();
  hri::htk::ModelSet again;
  again.parse(written, "again");
  if (again.to_text() != written) std::abort();
  for (const std::string& name : set.hmm_names()) {
    double log_skip = 0;
    hri::htk::to_chain(set.find('h', name)->hmm, &log_skip);
    if (set.num_codewords() == 0) hri::htk::to_hmm(set.find('h', name)->hmm);
  }
}

// Models of two and of one state.
const hri::htk::ModelSet& edited_models() {
  static const hri::htk::ModelSet models = [] {
    const std::string state = " <MEAN> 1 0.5 <VARIANCE> 1 2 ";
    hri::htk::ModelSet set;
    set.parse("~h a <BEGINHMM> <NUMSTATES> 4 <STATE> 2" + state + "<STATE> 3" + state +
                  "<TRANSP> 4 0 1 0 0 0 0.5 0.5 0 0 0 0.5 0.5 0 0 0 0 <ENDHMM> ~h sp <BEGINHMM> "
                  "<NUMSTATES> 3 <STATE> 2" +
                  state + "<TRANSP> 3 0 1 0 0 0.5 0.5 0 0 0 <ENDHMM>",
              "models");
    return set;
  }();
  return models;
}

void read_table(const std::string& text) {
  const auto table = hri::htk::VqTable::parse(text, "input");
  check_text(table);
  const hri::MatrixF frame = hri::MatrixF::Zero(1, table.dim());
  const int codeword = table.quantise(frame).front();
  if (codeword < 1 || codeword > table.num_codewords()) std::abort();
}

void read_trees(const std::string& text) {
  const auto trees = hri::htk::DecisionTrees::parse(text, "input");
  check_text(trees);
  for (const auto& tree : trees.trees) {
    if (trees.leaf_of(tree, "a-b+c").empty()) std::abort();
  }
}

void run_script(const std::string& text) {
  const auto script = hri::htk::EditScript::parse(text, "input");
  const hri::htk::ModelSet made = script.apply(edited_models());
  hri::htk::ModelSet again;
  again.parse(made.to_text(), "again");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  hri::fuzzing::expect_typed_errors([&] {
    const std::string text(data + 1, data + size);
    switch ((data[0] + 8) % 14) {
      case 0:
        read_parameters(data + 1, size - 1);
        break;
      case 1:
        check_text(hri::htk::MasterLabelFile::parse(text, "input"));
        break;
      case 2:
        check_text(hri::htk::Transcription::parse(text, "input"));
        break;
      case 3:
        check_text(hri::htk::Dictionary::parse(text, "input"));
        break;
      case 4:
        read_lattice(text);
        break;
      case 5:
        check_text(hri::htk::WordLattice::of_grammar(text, "input"));
        break;
      case 6:
        read_models(text);
        break;
      case 7:
        hri::htk::Configuration().parse(text, "input");
        break;
      case 8:
        run_script(text);
        break;
      case 9:
        read_table(text);
        break;
      case 10:
        read_trees(text);
        break;
      case 11:
        read_frames(data + 1, size - 1);
        break;
      case 12:
        hri::htk::detail::parse_statistics(text, "input");
        break;
      default:
        hri::htk::detail::parse_model_list(text, "input");
        break;
    }
  });
  return 0;
}
