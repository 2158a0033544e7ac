// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
//
// Against the formulas of the HTK Book, in double.
#include "hri/htk/feature_extractor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hri/core/error.hpp"
#include "hri/htk/configuration.hpp"

namespace hri::htk {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kRate = 8000;
constexpr int kLength = 200;
constexpr int kShift = 80;
constexpr int kFft = 256;

std::vector<float> audio() {
  std::vector<float> samples;
  std::uint32_t state = 1;
  for (int n = 0; n < 1000; ++n) {
    state = state * 1664525U + 1013904223U;
    const double noise = static_cast<double>(state >> 16U) / 65536 - 0.5;
    samples.push_back(
        static_cast<float>(0.02 + 0.3 * std::sin(0.2 * n) * std::exp(-n / 400.0) + 0.05 * noise));
  }
  return samples;
}

HtkFeatureOptions options() {
  HtkFeatureOptions o;
  o.frame_length_ms = 25;
  return o;
}

// A frame of 16-bit samples with pre-emphasis that begins anew, and a Hamming window.
std::vector<double> frame(const std::vector<float>& x, int t) {
  std::vector<double> s(kLength);
  for (int n = 0; n < kLength; ++n)
    s[static_cast<std::size_t>(n)] =
        32768.0 * static_cast<double>(x[static_cast<std::size_t>(t * kShift + n)]);
  for (std::size_t n = kLength - 1; n > 0; --n) s[n] -= 0.97 * s[n - 1];
  s[0] *= 1 - 0.97;
  for (std::size_t n = 0; n < kLength; ++n)
    s[n] *= 0.54 - 0.46 * std::cos(2 * kPi * static_cast<double>(n) / (kLength - 1));
  return s;
}

// Magnitudes through triangles on the mel axis (eq. 5.13 and what stands around it).
std::vector<double> filters(const std::vector<float>& x, int t, int count) {
  const std::vector<double> s = frame(x, t);
  const auto mel = [](double hz) { return 1127 * std::log(1 + hz / 700); };
  std::vector<double> out(static_cast<std::size_t>(count));
  const double step = mel(kRate / 2.0) / (count + 1);
  for (int k = 1; k < kFft / 2; ++k) {
    double re = 0;
    double im = 0;
    for (std::size_t n = 0; n < kLength; ++n) {
      re += s[n] * std::cos(2 * kPi * k * static_cast<double>(n) / kFft);
      im += s[n] * std::sin(2 * kPi * k * static_cast<double>(n) / kFft);
    }
    const double place = mel(static_cast<double>(k) * kRate / kFft) / step;
    for (int m = 0; m < count; ++m)
      out[static_cast<std::size_t>(m)] +=
          std::hypot(re, im) * std::max(0.0, 1 - std::fabs(place - (m + 1)));
  }
  return out;
}

double cepstrum(const std::vector<double>& energies, int i) {
  double sum = 0;
  const auto count = static_cast<double>(energies.size());
  for (std::size_t m = 0; m < energies.size(); ++m)
    sum += std::log(std::max(1.0, energies[m])) *
           std::cos(kPi * i / count * (static_cast<double>(m) + 0.5));
  return std::sqrt(2 / count) * sum * (i == 0 ? 1 : 1 + 11 * std::sin(kPi * i / 22));
}

TEST(FeatureExtractor, ComputesFilterBanksAsTheBookHasThem) {
  const std::vector<float> x = audio();
  const FeatureExtractor log_bank(ParameterKind::parse("FBANK"), kRate, options());
  const FeatureExtractor bank(ParameterKind::parse("MELSPEC"), kRate, options());
  const MatrixF logs = log_bank.compute(x);
  const MatrixF energies = bank.compute(x);
  ASSERT_EQ(logs.rows(), (1000 - kLength) / kShift + 1);
  ASSERT_EQ(logs.cols(), 20);
  for (const int t : {0, 7}) {
    const std::vector<double> expected = filters(x, t, 20);
    for (int m = 0; m < 20; ++m) {
      const double e = expected[static_cast<std::size_t>(m)];
      EXPECT_NEAR(logs(t, m), std::log(e), 2e-4);
      EXPECT_NEAR(energies(t, m), e, 3e-4 * e);
    }
  }
}

TEST(FeatureExtractor, ComputesCepstraC0AndEnergyInHtksOrder) {
  const std::vector<float> x = audio();
  HtkFeatureOptions o = options();
  o.normalise_energy = false;
  const FeatureExtractor extractor(ParameterKind::parse("MFCC_E_0"), kRate, o);
  const MatrixF rows = extractor.compute(x);
  ASSERT_EQ(rows.cols(), 14);
  EXPECT_EQ(extractor.num_columns(), 14);
  EXPECT_EQ(extractor.sample_period(), 100000);
  for (const int t : {0, 5}) {
    const std::vector<double> energies = filters(x, t, 20);
    for (int i = 1; i <= 12; ++i) EXPECT_NEAR(rows(t, i - 1), cepstrum(energies, i), 5e-3);
    EXPECT_NEAR(rows(t, 12), cepstrum(energies, 0), 2e-3);
    double energy = 0;
    for (int n = 0; n < kLength; ++n)
      energy +=
          std::pow(32768.0 * static_cast<double>(x[static_cast<std::size_t>(t * kShift + n)]), 2);
    EXPECT_NEAR(rows(t, 13), std::log(energy), 1e-4);
  }
}

TEST(FeatureExtractor, NormalisesEnergyToTheLoudestFrame) {
  std::vector<float> x = audio();
  std::fill(x.begin() + 600, x.end(), 0.0F);
  const FeatureExtractor extractor(ParameterKind::parse("MFCC_E"), kRate, options());
  const VectorF energy = extractor.compute(x).rightCols(1);
  EXPECT_FLOAT_EQ(energy.maxCoeff(), 1);
  EXPECT_NEAR(energy.minCoeff(), 1 - 0.1 * 50 * std::log(10.0) / 10, 1e-5);
}

TEST(FeatureExtractor, AddsDifferencesByTheBooksFormula) {
  const std::vector<float> x = audio();
  HtkFeatureOptions o = options();
  o.delta_window = 3;
  o.acceleration_window = 1;
  const MatrixF rows = FeatureExtractor(ParameterKind::parse("MFCC_0_D_A"), kRate, o).compute(x);
  ASSERT_EQ(rows.cols(), 39);
  const auto at = [&](Eigen::Index t, Eigen::Index c) {
    return static_cast<double>(rows(std::clamp<Eigen::Index>(t, 0, rows.rows() - 1), c));
  };
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    for (Eigen::Index c = 0; c < 13; ++c) {
      double delta = 0;
      for (int k = 1; k <= 3; ++k) delta += k * (at(t + k, c) - at(t - k, c));
      EXPECT_NEAR(rows(t, 13 + c), delta / 28, 2e-4);
      EXPECT_NEAR(rows(t, 26 + c), (at(t + 1, 13 + c) - at(t - 1, 13 + c)) / 2, 2e-4);
    }
  }
}

TEST(FeatureExtractor, SubtractsTheMeanOfAllButTheEnergy) {
  const std::vector<float> x = audio();
  const MatrixF with =
      FeatureExtractor(ParameterKind::parse("MFCC_0_E_D_Z"), kRate, options()).compute(x);
  const MatrixF without =
      FeatureExtractor(ParameterKind::parse("MFCC_0_E_D"), kRate, options()).compute(x);
  EXPECT_LT(with.leftCols(13).colwise().mean().cwiseAbs().maxCoeff(), 1e-4F);
  EXPECT_EQ(with.rightCols(15), without.rightCols(15));
  const MatrixF centred = without.leftCols(13).rowwise() - without.leftCols(13).colwise().mean();
  EXPECT_LT((with.leftCols(13) - centred).cwiseAbs().maxCoeff(), 1e-3F);
}

TEST(FeatureExtractor, LeavesOutTheAbsoluteEnergy) {
  const std::vector<float> x = audio();
  const MatrixF all =
      FeatureExtractor(ParameterKind::parse("MFCC_E_D"), kRate, options()).compute(x);
  const MatrixF rest =
      FeatureExtractor(ParameterKind::parse("MFCC_E_D_N"), kRate, options()).compute(x);
  ASSERT_EQ(rest.cols(), 25);
  EXPECT_EQ(rest.leftCols(12), all.leftCols(12));
  EXPECT_EQ(rest.rightCols(13), all.rightCols(13));
}

TEST(FeatureExtractor, PredictsLinearly) {
  const std::vector<float> x = audio();
  HtkFeatureOptions o = options();
  o.lifter = 0;
  const MatrixF a = FeatureExtractor(ParameterKind::parse("LPC"), kRate, o).compute(x);
  const MatrixF c = FeatureExtractor(ParameterKind::parse("LPCEPSTRA"), kRate, o).compute(x);
  ASSERT_EQ(a.cols(), 12);
  for (Eigen::Index t = 0; t < a.rows(); ++t) {
    // The normal equations of the autocorrelation method.
    const std::vector<double> s = frame(x, static_cast<int>(t));
    std::vector<double> r(13);
    for (std::size_t k = 0; k <= 12; ++k) {
      for (std::size_t n = 0; n + k < s.size(); ++n) r[k] += s[n] * s[n + k];
    }
    for (int i = 1; i <= 12; ++i) {
      double sum = r[static_cast<std::size_t>(i)];
      for (int j = 1; j <= 12; ++j)
        sum += static_cast<double>(a(t, j - 1)) * r[static_cast<std::size_t>(std::abs(i - j))];
      EXPECT_NEAR(sum / r[0], 0, 1e-5);
    }
    // c1 = -a1, c2 = -a2 + a1^2 / 2 (eq. 5.10).
    EXPECT_NEAR(c(t, 0), -a(t, 0), 1e-4);
    EXPECT_NEAR(c(t, 1), -a(t, 1) + a(t, 0) * a(t, 0) / 2, 1e-3);
  }
}

TEST(FeatureExtractor, RefusesWhatIsNotComputedAndBadAudio) {
  for (const char* kind : {"PLP", "WAVEFORM", "ANON", "FBANK_0", "LPDELCEP"})
    EXPECT_THROW(FeatureExtractor(ParameterKind::parse(kind), kRate), InvalidArgument) << kind;
  const FeatureExtractor extractor(ParameterKind::parse("MFCC_E"), kRate, options());
  EXPECT_THROW((void)extractor.compute(std::vector<float>(199)), InvalidArgument);
  std::vector<float> x = audio();
  x[700] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW((void)extractor.compute(x), InvalidArgument);
  HtkFeatureOptions o;
  o.num_cepstra = 20;
  EXPECT_THROW(FeatureExtractor(ParameterKind::parse("MFCC"), kRate, o), InvalidArgument);
}

TEST(Convert, AddsAndLeavesOutDifferences) {
  const std::vector<float> x = audio();
  ParameterFile file;
  file.kind = ParameterKind::parse("MFCC_0");
  file.values = FeatureExtractor(file.kind, kRate, options()).compute(x);
  const ParameterKind full = ParameterKind::parse("MFCC_0_D_A_T");
  const ParameterFile longer = convert(file, full);
  EXPECT_EQ(longer.values, FeatureExtractor(full, kRate, options()).compute(x));
  EXPECT_EQ(convert(longer, file.kind).values, file.values);
  EXPECT_EQ(convert(longer, ParameterKind::parse("MFCC_0_D")).values, longer.values.leftCols(26));
  const ParameterFile centred = convert(longer, ParameterKind::parse("ANON_0_D_Z"));
  EXPECT_LT(centred.values.leftCols(13).colwise().mean().cwiseAbs().maxCoeff(), 1e-4F);
  EXPECT_THROW(convert(centred, full), InvalidArgument);
  EXPECT_THROW(convert(file, ParameterKind::parse("FBANK")), InvalidArgument);
  EXPECT_THROW(convert(file, ParameterKind::parse("LPC_0")), InvalidArgument);
  EXPECT_THROW(convert(file, ParameterKind::parse("MFCC_E")), InvalidArgument);
  const MatrixF seen = observations(file, ParameterKind::parse("MFCC_0_D_N"));
  EXPECT_EQ(seen.cols(), 25);
  EXPECT_EQ(seen.leftCols(12), file.values.leftCols(12));
}

// Frames of a file of the one kind as another, beside those of the audio itself.
double error_of_conversion(const std::string& from, const std::string& to) {
  const std::vector<float> x = audio();
  ParameterFile file;
  file.kind = ParameterKind::parse(from);
  file.values = FeatureExtractor(file.kind, kRate, options()).compute(x);
  const ParameterKind kind = ParameterKind::parse(to);
  const MatrixF made = convert(file, kind, options()).values;
  const MatrixF expected = FeatureExtractor(kind, kRate, options()).compute(x);
  EXPECT_EQ(made.rows(), expected.rows());
  EXPECT_EQ(made.cols(), expected.cols());
  return static_cast<double>((made - expected).cwiseAbs().maxCoeff() /
                             expected.cwiseAbs().maxCoeff());
}

TEST(Convert, MakesKindsOfThoseThatSayMore) {
  // Float files between: their rounding is all that differs.
  EXPECT_LT(error_of_conversion("FBANK", "MFCC_0_D_A"), 1e-5);
  EXPECT_LT(error_of_conversion("FBANK_E_D", "MFCC_E_D_Z"), 1e-5);
  EXPECT_LT(error_of_conversion("MELSPEC", "FBANK"), 1e-5);
  EXPECT_LT(error_of_conversion("MELSPEC", "MFCC"), 1e-5);
  EXPECT_LT(error_of_conversion("LPC_E", "LPCEPSTRA_E_D"), 1e-4);
  EXPECT_LT(error_of_conversion("LPC", "LPREFC"), 1e-4);
  EXPECT_LT(error_of_conversion("LPREFC", "LPC"), 1e-4);
  EXPECT_LT(error_of_conversion("LPREFC_D", "LPCEPSTRA"), 1e-4);
}

TEST(FeatureExtractor, GivesReflectionCoefficientsOfTheBooksRecursion) {
  const std::vector<float> x = audio();
  const MatrixF k = FeatureExtractor(ParameterKind::parse("LPREFC"), kRate, options()).compute(x);
  const MatrixF a = FeatureExtractor(ParameterKind::parse("LPC"), kRate, options()).compute(x);
  EXPECT_LT(k.cwiseAbs().maxCoeff(), 1);
  for (Eigen::Index t = 0; t < k.rows(); ++t) {
    std::vector<double> now;
    for (Eigen::Index i = 0; i < k.cols(); ++i) {
      const std::vector<double> before = now;
      for (std::size_t j = 0; j < before.size(); ++j)
        now[j] = before[j] - static_cast<double>(k(t, i)) * before[before.size() - 1 - j];
      now.push_back(-static_cast<double>(k(t, i)));
    }
    for (Eigen::Index i = 0; i < k.cols(); ++i)
      EXPECT_NEAR(now[static_cast<std::size_t>(i)], static_cast<double>(a(t, i)), 1e-3);
  }
  const MatrixF integers =
      FeatureExtractor(ParameterKind::parse("IREFC"), kRate, options()).compute(x);
  EXPECT_EQ(integers, k);
}

std::string refusal_of_options(const std::string& text) {
  Configuration configuration;
  try {
    configuration.parse(text, "config");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Configuration, SetsWhatFilesSet) {
  Configuration c;
  c.parse(
      "# coding\n TARGETKIND = MFCC_0_D  # as in the book\r\nTARGETRATE=100000.0\n"
      "HPARM: WINDOWSIZE = 250000.0\nSAVECOMPRESSED = T\nsavewithcrc = f\nNUMCHANS = 26\n"
      "ENORMALISE = FALSE\nLOFREQ = -1\nFORCECXTEXP = F\nMAXTRYOPEN = 2\nSOURCEFORMAT = \"WAV\"\n",
      "config");
  EXPECT_EQ(c.target.text(), "MFCC_D_0");
  EXPECT_TRUE(c.has_target_rate);
  EXPECT_EQ(c.features.frame_shift_ms, 10);
  EXPECT_EQ(c.features.frame_length_ms, 25);
  EXPECT_EQ(c.features.num_filters, 26);
  EXPECT_FALSE(c.features.normalise_energy);
  EXPECT_EQ(c.source_format, SourceFormat::wav);
  EXPECT_EQ(c.ignored, std::vector<std::string>{"MAXTRYOPEN"});
  EXPECT_EQ(c.written_kind(ParameterKind()).text(), "MFCC_D_C_0");
  EXPECT_EQ(Configuration().written_kind(ParameterKind::parse("FBANK_C")).text(), "FBANK_K");
}

TEST(Configuration, RefusesWhatWouldChangeValues) {
  for (const char* setting :
       {"NATURALREADORDER = T", "BYTEORDER = VAX", "CMEANDIR = means", "VARSCALEFN = scale",
        "MATTRANFN = matrix", "STEREOMODE = LEFT", "LABELFORMAT = TIMIT", "NSTREAMS = 4",
        "SAVEBINARY = T", "HWAVEFILTER = 'gunzip $'"}) {
    EXPECT_NE(refusal_of_options(std::string("\n") + setting + "\n").find("config: line 2: "),
              std::string::npos)
        << setting;
  }
  EXPECT_EQ(refusal_of_options("NATURALREADORDER = F\nBYTEORDER = NONVAX\nLABELFORMAT = HTK\n"
                               "NSTREAMS = 1\nSOURCERATE = 625\n"),
            "nothing thrown");
}

TEST(Configuration, HasSettingsOfLiveSoundWhereItIsAskedFor) {
  const std::string settings =
      "SOURCERATE = 625.0\nSOURCEKIND = HAUDIO\nUSESILDET = T\nMEASURESIL = T\n"
      "SPEECHTHRESH = 9\nSILSEQCOUNT = 70\nHVITE: RECOUTPREFIX = 'out/s'\nRECOUTSUFFIX = x\n";
  Configuration c;
  c.live = true;
  c.parse(settings, "config");
  EXPECT_EQ(c.source_rate_hz, 16000);
  EXPECT_EQ(c.silence_frames, 70);
  EXPECT_EQ(c.record_prefix, "out/s");
  EXPECT_EQ(c.record_suffix, "x");
  EXPECT_EQ(c.ignored, (std::vector<std::string>{"MEASURESIL", "SPEECHTHRESH"}));
  c.parse("SOURCERATE = 907.03\n", "config");
  EXPECT_EQ(c.source_rate_hz, 11025);
  for (const char* setting : {"USESILDET = F", "SOURCERATE = 0", "SOURCERATE = -625",
                              "SOURCERATE = 16000", "SOURCERATE = 1e-30", "SOURCEKIND = MFCC"})
    EXPECT_THROW(c.parse(setting, "config"), FormatError) << setting;
}

TEST(Configuration, RefusesSettingsOfLiveSoundForFiles) {
  EXPECT_EQ(refusal_of_options("\nSOURCEKIND = HAUDIO\n"),
            "config: line 2: SOURCEKIND = HAUDIO is of live sound, and files are read here");
  for (const char* setting :
       {"USESILDET = T", "MEASURESIL = T", "RECOUTPREFIX = s", "RECOUTSUFFIX = s"})
    EXPECT_NE(refusal_of_options(setting).find("is of live sound"), std::string::npos) << setting;
  EXPECT_EQ(refusal_of_options("USESILDET = F\nMEASURESIL = F\nSOURCEKIND = WAVEFORM\n"),
            "nothing thrown");
}

TEST(Configuration, KeepsSettingsAsTheyCame) {
  Configuration c;
  c.parse("HPARM: numchans = 26  # filters\n", "config");
  ASSERT_EQ(c.settings.size(), 1U);
  EXPECT_EQ(c.settings[0].first, "NUMCHANS");
  EXPECT_EQ(c.settings[0].second, "26");
}

TEST(Configuration, RefusesByNameAndLine) {
  EXPECT_EQ(refusal_of_options("\nTARGETRATE\n"), "config: line 2: expected KEY = VALUE");
  EXPECT_EQ(refusal_of_options("NUMCHANS = many\n"),
            "config: line 1: 'many' is no number that can stand here");
  EXPECT_EQ(refusal_of_options("PREEMCOEF = 1.5\n"),
            "config: line 1: PREEMCOEF: HtkFeatureOptions.pre_emphasis must lie in 0..1, got 1.5");
  EXPECT_EQ(refusal_of_options("USEPOWER = 1\n"), "config: line 1: '1' is neither T nor F");
  EXPECT_NE(
      refusal_of_options("TARGETKIND = MFCC_C\n").find("config: line 1: TARGETKIND takes no _C"),
      std::string::npos);
  EXPECT_NE(refusal_of_options("SOURCEFORMAT = NIST\n").find("NIST is not supported"),
            std::string::npos);
  EXPECT_NE(refusal_of_options("ADDDITHER = 1.0\n").find("ADDDITHER = 1.0 is not supported"),
            std::string::npos);
  EXPECT_EQ(refusal_of_options("ADDDITHER = 0.0\nSIMPLEDIFFS = F\nCEPSCALE = 1\n"),
            "nothing thrown");
  EXPECT_EQ(refusal_of_options("NUMCEPS = \"12\n"), "config: line 1: a quotation does not end");
  EXPECT_EQ(refusal_of_options("NUMCEPS = 12\n\xff\n"), "config: line 2: is not UTF-8 text");
}

}  // namespace
}  // namespace hri::htk
