// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// SubwordRecognizer to and from a model file.
#include <utility>

#include "hri/core/error.hpp"
#include "hri/recognition/subword/subword_recognizer.hpp"
#include "io/option_fields.hpp"
#include "recognition/reading.hpp"

namespace hri {
namespace {

constexpr const char* kKind = "subword_recognizer";

std::string prefix_of(std::size_t unit) { return "hmm." + std::to_string(unit) + "."; }

}  // namespace

ModelFile SubwordRecognizer::to_model_file() const {
  ModelFile file;
  file.set_kind(kKind);
  file.set_text_list("labels", labels_);
  file.set_text_list("unrecorded", unrecorded_);
  detail::write_options(options_, file);
  file.set_text("lexicon", lexicon_.to_text());
  file.set_text_list("units", units_.names);
  for (std::size_t u = 0; u < units_.models.size(); ++u) units_.models[u].write(file, prefix_of(u));
  file.set_vector("final_stays", VectorD(Eigen::Map<const VectorD>(
                                     units_.final_stays.data(),
                                     static_cast<Eigen::Index>(units_.final_stays.size()))));
  calibration_.write(file);
  return file;
}

void SubwordRecognizer::save(const std::string& path) const { to_model_file().write(path); }

SubwordRecognizer SubwordRecognizer::load(const std::string& path) {
  return from_model_file(ModelFile::read(path));
}

SubwordRecognizer SubwordRecognizer::from_model_file(const ModelFile& file) {
  if (file.kind() != kKind) {
    fail(ErrorKind::format,
         file.name() + ": kind is '" + file.kind() + "', expected '" + kKind + "'");
  }
  return detail::with_context(file, [&] { return read(file); });
}

SubwordRecognizer SubwordRecognizer::read(const ModelFile& file) {
  SubwordRecognizerOptions options;
  detail::read_options(file, &options);
  htk::Dictionary lexicon = htk::Dictionary::parse(file.text("lexicon"), file.name() + ": lexicon");
  UnitModels units;
  units.names = file.text_list("units");
  for (std::size_t u = 0; u < units.names.size(); ++u)
    units.models.push_back(GaussianMixtureHmm::read(file, prefix_of(u)));
  const VectorD stays = file.vector_d("final_stays");
  units.final_stays.assign(stays.data(), stays.data() + stays.size());
  const Calibration calibration = Calibration::read(file);
  const std::vector<std::string> labels = file.text_list("labels");
  std::vector<std::string> unrecorded = file.text_list("unrecorded");
  file.require_all_read();
  SubwordRecognizer result(options, std::move(lexicon), std::move(units), calibration,
                           std::move(unrecorded));
  if (result.labels() != labels)
    fail(ErrorKind::format, file.name() + ": the labels are not the words of the lexicon");
  const auto num_thresholds = calibration.class_thresholds().size();
  if (num_thresholds != 0 && num_thresholds != static_cast<Eigen::Index>(labels.size()))
    fail(ErrorKind::format, file.name() + ": there are not as many class thresholds as labels");
  return result;
}

}  // namespace hri
