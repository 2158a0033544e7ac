// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#include "hri/htk/parameter_file.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hri/core/error.hpp"
#include "hri/htk/feature_extractor.hpp"
#include "hri/io/file.hpp"

namespace hri::htk {
namespace {

using Bytes = std::vector<std::uint8_t>;

ParameterFile sample(const std::string& kind, int columns = 6) {
  ParameterFile file;
  file.kind = ParameterKind::parse(kind);
  file.values.resize(5, columns);
  for (Eigen::Index i = 0; i < file.values.size(); ++i)
    file.values.data()[i] = static_cast<float>(i * i) / 7 - 3;
  return file;
}

// Files of all kinds, of 5 frames.
std::vector<ParameterFile> samples() {
  std::vector<ParameterFile> files;
  for (const char* kind : {"MFCC", "MFCC_K", "MFCC_C", "MFCC_C_K", "USER_D_A_K"})
    files.push_back(sample(kind));
  for (const char* kind : {"WAVEFORM", "DISCRETE_K", "IREFC_K"}) {
    files.push_back(sample(kind, 1));
    files.back().values << 0, 1, -1, 1, 0;
  }
  return files;
}

std::string temporary(const std::string& name) { return testing::TempDir() + "hri_" + name; }

std::string refusal_of_bytes(const Bytes& bytes) {
  try {
    ParameterFile::parse(bytes, "a.mfc");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(ParameterKind, HasHtksCodesAndNames) {
  // HTK Book, section 5.10.1, and kinds that programs in use know by number.
  EXPECT_EQ(ParameterKind::parse("MFCC_0_D_A").code(), 8966);
  EXPECT_EQ(ParameterKind::parse("MFCC_E_D_A").code(), 838);
  EXPECT_EQ(ParameterKind::parse("fbank_k").code(), 7 + 4096);
  EXPECT_EQ(ParameterKind::parse("MFCC_0_A_D").text(), "MFCC_D_A_0");
  EXPECT_EQ(ParameterKind::parse("PLP_Z_0_T_A_D_E_N_C_K").text(), "PLP_E_D_N_A_T_C_K_Z_0");
  EXPECT_EQ(ParameterKind::parse("USER").num_blocks(), 1);
  EXPECT_EQ(ParameterKind::parse("USER_D_A_T").num_blocks(), 4);
}

TEST(ParameterKind, RefusesWhatThereIsNot) {
  for (const char* name : {"", "MFC", "MFCC_", "MFCC_X", "MFCC_D_D", "MFCC_A", "MFCC_D_T", "MFCC_N",
                           "MFCC_V", "WAVEFORM_E", "DISCRETE_C", "MFCC D"})
    EXPECT_THROW(ParameterKind::parse(name), InvalidArgument) << name;
}

TEST(ParameterFile, IsLaidOutAsHtkHasIt) {
  ParameterFile file;
  file.kind = ParameterKind::parse("MFCC");
  file.values.resize(1, 2);
  file.values << 1.0F, -2.0F;
  const Bytes expected{0, 0, 0, 1, 0, 1, 0x86, 0xa0, 0, 8, 0, 6, 0x3f, 0x80, 0, 0, 0xc0, 0, 0, 0};
  EXPECT_EQ(file.serialise(), expected);
}

TEST(ParameterFile, ChecksumIsOfBigEndianWords) {
  ParameterFile file = sample("USER_K", 1);
  const Bytes bytes = file.serialise();
  std::uint32_t sum = 0;
  for (std::size_t i = 12; i + 2 < bytes.size(); i += 2)
    sum = (sum * 65536 + bytes[i] * 256U + bytes[i + 1]) % 36897;
  EXPECT_EQ(bytes[bytes.size() - 2] * 256U + bytes.back(), sum);
}

TEST(ParameterFile, IsWrittenAgainAsItWasRead) {
  for (const char* kind :
       {"MFCC", "MFCC_K", "MFCC_C", "MFCC_C_K", "MFCC_E_D", "MFCC_0_D_A_K", "FBANK_D_A_T", "USER_C",
        "LPC_E", "LPREFC_C", "LPCEPSTRA_D_A_K", "LPCEPSTRA_E_D_Z", "MFCC_Z", "MFCC_0_D_A_Z",
        "MFCC_0_D_Z_C_K", "MELSPEC", "PLP_0_D_A_Z_K"}) {
    const int columns = 6 * ParameterKind::parse(kind).num_blocks();
    const Bytes bytes = sample(kind, columns).serialise();
    const ParameterFile read = ParameterFile::parse(bytes, kind);
    EXPECT_EQ(read.serialise(), bytes) << kind;
    EXPECT_EQ(read.kind.text(), ParameterKind::parse(kind).text());
    EXPECT_EQ(read.num_static(), 6);
  }
}

// Bytes as another program writes them, not as they are written here: every 16 bits there are.
TEST(ParameterFile, OfIntegersIsWrittenAgainAsItWasRead) {
  for (const char* name : {"WAVEFORM", "DISCRETE", "DISCRETE_K", "IREFC", "IREFC_K", "IREFC_D_Z"}) {
    const ParameterKind kind = ParameterKind::parse(name);
    const int columns = kind.num_blocks();
    const auto frames = static_cast<std::uint32_t>(65536 / columns);
    Bytes bytes;
    const auto word = [&](unsigned value) {
      bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
      bytes.push_back(static_cast<std::uint8_t>(value & 0xffU));
    };
    word(frames >> 16U);
    word(frames & 0xffffU);
    word(0);
    word(625);
    word(2U * static_cast<unsigned>(columns));
    word(kind.code());
    std::uint32_t sum = 0;
    for (unsigned value = 0; value < 65536; ++value) {
      word(value);
      sum = (sum * 65536 + value) % 36897;
    }
    if (kind.has(kChecksum)) word(sum);
    const ParameterFile read = ParameterFile::parse(bytes, name);
    EXPECT_EQ(read.serialise(), bytes) << name;
    EXPECT_EQ(read.sample_period, 625);
    EXPECT_EQ(read.kind.text(), kind.text());
  }
}

TEST(ParameterFile, KeepsValuesToTheBitWithoutCompression) {
  const ParameterFile file = sample("MFCC_E");
  EXPECT_EQ(ParameterFile::parse(file.serialise(), "a").values, file.values);
}

TEST(ParameterFile, CompressesWithinHalfAStep) {
  ParameterFile file = sample("MFCC_C");
  file.values.col(2).setConstant(-7.25F);
  const MatrixF read = ParameterFile::parse(file.serialise(), "a").values;
  for (Eigen::Index c = 0; c < read.cols(); ++c) {
    const float step = (file.values.col(c).maxCoeff() - file.values.col(c).minCoeff()) / 65534;
    EXPECT_LE((read.col(c) - file.values.col(c)).cwiseAbs().maxCoeff(), 0.51F * step);
  }
}

TEST(ParameterFile, HoldsIntegersOfWaveformsAndCodewords) {
  for (const char* kind : {"WAVEFORM", "DISCRETE_K"}) {
    ParameterFile file;
    file.kind = ParameterKind::parse(kind);
    file.values.resize(3, 1);
    file.values << 0, 32767, -32768;
    const Bytes bytes = file.serialise();
    EXPECT_EQ(ParameterFile::parse(bytes, kind).values, file.values);
    file.values(1) = 32768;
    EXPECT_THROW((void)file.serialise(), InvalidArgument);
  }
  ParameterFile file = sample("IREFC", 1);
  file.values << 0, 1, -1, 0.5F, 0.25F;
  const Bytes bytes = file.serialise();
  EXPECT_EQ(ParameterFile::parse(bytes, "k").serialise(), bytes);
}

TEST(ParameterFile, LeavesOutThatEnergyIsSuppressed) {
  ParameterFile file = sample("MFCC_E_D_N");
  EXPECT_EQ(ParameterFile::parse(file.serialise(), "a").kind.text(), "MFCC_E_D");
}

TEST(ParameterFile, RefusesDamagedFilesByNameAndByte) {
  const Bytes good = sample("MFCC_K").serialise();
  EXPECT_EQ(refusal_of_bytes(good), "nothing thrown");
  EXPECT_EQ(refusal_of_bytes({}), "a.mfc: byte 0: the header takes 12 bytes");
  Bytes bytes = good;
  bytes.pop_back();
  EXPECT_EQ(refusal_of_bytes(bytes), "a.mfc: byte 0: the header says 134 bytes, the file has 133");
  bytes = good;
  bytes[0] = 0x7f;
  EXPECT_NE(refusal_of_bytes(bytes).find("a.mfc: byte 0: the header says"), std::string::npos);
  bytes[0] = 0xff;
  EXPECT_EQ(refusal_of_bytes(bytes), "a.mfc: byte 0: the number of frames is not above 0");
  bytes = good;
  bytes[4] = 0xff;
  EXPECT_EQ(refusal_of_bytes(bytes), "a.mfc: byte 4: the sample period is not above 0");
  bytes = good;
  bytes[9] = 0;
  EXPECT_EQ(refusal_of_bytes(bytes), "a.mfc: byte 8: a frame of MFCC_K cannot take 0 bytes");
  bytes = good;
  bytes[11] = 63;
  EXPECT_NE(refusal_of_bytes(bytes).find("a.mfc: byte 10: the parameter kind"), std::string::npos);
  bytes = good;
  bytes[40] ^= 1;
  EXPECT_EQ(refusal_of_bytes(bytes), "a.mfc: byte 132: the checksum is wrong: the file is damaged");
  bytes = sample("MFCC").serialise();
  bytes[12] = 0x7f;
  bytes[13] = 0xc0;
  EXPECT_EQ(refusal_of_bytes(bytes), "a.mfc: byte 12: a value is not finite");
}

TEST(ParameterFile, RefusesEveryCutFile) {
  for (const char* kind : {"MFCC_C_K", "MFCC_E_D"}) {
    const Bytes good = sample(kind).serialise();
    for (std::size_t size = 0; size < good.size(); ++size)
      EXPECT_NE(refusal_of_bytes({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}),
                "nothing thrown");
  }
}

TEST(ParameterFile, RefusesToWriteWhatNoFileCanHold) {
  ParameterFile file = sample("MFCC");
  file.values(0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW((void)file.serialise(), InvalidArgument);
  EXPECT_THROW((void)sample("MFCC_D_A_T").serialise(), InvalidArgument);
  EXPECT_THROW((void)sample("WAVEFORM").serialise(), InvalidArgument);
  file = sample("MFCC");
  file.kind = ParameterKind();
  EXPECT_THROW((void)file.serialise(), InvalidArgument);
  file = sample("MFCC");
  file.sample_period = 0;
  EXPECT_THROW((void)file.serialise(), InvalidArgument);
  file = sample("MFCC_C");
  file.scale = {1, 2};
  EXPECT_THROW((void)file.serialise(), InvalidArgument);
}

TEST(ParameterFile, PartsAreThoseOfTheWholeToTheBit) {
  const std::string path = temporary("parts.mfc");
  for (const ParameterFile& file : samples()) {
    const std::string kind = file.kind.text();
    file.write(path);
    const Bytes bytes = file.serialise();
    EXPECT_EQ(read_file(path), bytes) << kind;
    const ParameterFile whole = ParameterFile::parse(bytes, kind);
    EXPECT_EQ(ParameterFile::read(path).values, whole.values) << kind;
    for (std::int64_t first = 0; first < 5; ++first) {
      for (std::int64_t last = first + 1; last <= 5; ++last) {
        const ParameterFile part = ParameterFile::read_frames(path, first, last);
        EXPECT_EQ(part.values, whole.values.middleRows(first, last - first)) << kind;
        EXPECT_EQ(part.kind, whole.kind);
        EXPECT_EQ(part.sample_period, whole.sample_period);
        EXPECT_EQ(part.scale, whole.scale);
        EXPECT_EQ(part.offset, whole.offset);
        EXPECT_EQ(ParameterFile::parse_frames(bytes, kind, first, last).values, part.values);
      }
    }
    const ParameterHeader header = ParameterHeader::read(path);
    EXPECT_EQ(header.kind, whole.kind);
    EXPECT_EQ(header.num_frames, 5);
    EXPECT_EQ(header.num_columns, whole.values.cols());
    EXPECT_NO_THROW(ParameterFile::verify(path));
  }
}

TEST(ParameterFile, IsReadAcrossTheEdgesOfItsWindow) {
  const std::string path = temporary("long.mfc");
  ParameterFile file;
  file.kind = ParameterKind::parse("MFCC_K");
  file.values.resize(3001, 39);  // 7 windows of 64 KiB, and a part of one
  for (Eigen::Index i = 0; i < file.values.size(); ++i)
    file.values.data()[i] = static_cast<float>(i);
  file.write(path);
  EXPECT_EQ(read_file(path), file.serialise());
  EXPECT_EQ(ParameterFile::read(path).values, file.values);
  for (const std::int64_t first : {0, 419, 420, 2999})
    EXPECT_EQ(ParameterFile::read_frames(path, first, 3000).values,
              file.values.middleRows(first, 3000 - first));
}

TEST(ParameterFile, RefusesPartsThatThereAreNot) {
  const std::string path = temporary("bounds.mfc");
  sample("MFCC").write(path);
  for (const auto& [first, last] : {std::pair{-1, 2}, {2, 2}, {3, 2}, {0, 0}})
    EXPECT_THROW(ParameterFile::read_frames(path, first, last), InvalidArgument) << first;
  EXPECT_THROW(ParameterFile::read_frames(path, 4, 6), FormatError);
  EXPECT_THROW(ParameterFile::read_frames(path, 0, std::numeric_limits<std::int64_t>::max()),
               FormatError);
  EXPECT_THROW(ParameterFile::read_frames(temporary("none.mfc"), 0, 1), IoError);
  EXPECT_THROW(ParameterHeader::read(testing::TempDir()), IoError);
}

TEST(ParameterFile, PartsOfDamagedFilesAreRefused) {
  const std::string path = temporary("damaged.mfc");
  for (const char* kind : {"MFCC_C_K", "MFCC_E_D"}) {
    const Bytes good = sample(kind).serialise();
    for (std::size_t size = 0; size < good.size(); ++size) {
      write_file_atomically(path, {good.data(), size});
      EXPECT_THROW(ParameterFile::read_frames(path, 0, 1), FormatError) << size;
      EXPECT_THROW(ParameterHeader::read(path), FormatError) << size;
      EXPECT_THROW(ParameterFile::verify(path), FormatError) << size;
    }
  }
  // A checksum needs every byte: that of a part alone is not checked, that of all frames is.
  Bytes bytes = sample("MFCC_K").serialise();
  bytes[40] ^= 1;  // in the second frame
  write_file_atomically(path, bytes);
  EXPECT_NO_THROW(ParameterFile::read_frames(path, 0, 1));
  EXPECT_THROW(ParameterFile::read_frames(path, 0, 5), FormatError);
  EXPECT_THROW(ParameterFile::read(path), FormatError);
  EXPECT_THROW(ParameterFile::verify(path), FormatError);
  // Nor are the values of other frames.
  bytes = sample("MFCC").serialise();
  bytes[12] = 0x7f;
  bytes[13] = 0xc0;
  write_file_atomically(path, bytes);
  EXPECT_NO_THROW(ParameterFile::read_frames(path, 1, 5));
  EXPECT_THROW(ParameterFile::read_frames(path, 0, 1), FormatError);
}

TEST(FramesBeside, MakePartsAsTheyAreInTheWhole) {
  HtkFeatureOptions options;
  options.acceleration_window = 3;
  ParameterFile file;
  file.values.resize(60, 13);
  for (Eigen::Index i = 0; i < file.values.size(); ++i)
    file.values.data()[i] = static_cast<float>(i * 7919 % 1000) / 37;
  for (const char* from : {"MFCC_0", "MFCC_0_Z"}) {
    file.kind = ParameterKind::parse(from);
    for (const char* letters : {"", "_D", "_D_A", "_D_A_T"}) {
      const ParameterKind to = ParameterKind::parse(std::string(from) + letters);
      const MatrixF whole = convert(file, to, options).values;
      const auto beside = frames_beside(file.kind, to, options);
      ASSERT_TRUE(beside.has_value());
      EXPECT_EQ(*beside, std::vector<int>({0, 2, 5, 7})[to.num_blocks() - 1U]);
      for (Eigen::Index first = 0; first < 60; first += 7) {
        const Eigen::Index begin = std::max<Eigen::Index>(first - *beside, 0);
        const Eigen::Index end = std::min<Eigen::Index>(first + 3 + *beside, 60);
        ParameterFile part = file;
        part.values = file.values.middleRows(begin, end - begin);
        EXPECT_EQ(convert(part, to, options).values.middleRows(first - begin, 3),
                  whole.middleRows(first, 3));
      }
    }
  }
  const auto kind = [](const char* name) { return ParameterKind::parse(name); };
  EXPECT_EQ(frames_beside(kind("MFCC_0_D_A"), kind("MFCC_0_D"), options), 0);
  EXPECT_FALSE(frames_beside(kind("MFCC_0"), kind("MFCC_0_Z"), options).has_value());
  EXPECT_FALSE(frames_beside(kind("FBANK"), kind("MFCC_0"), options).has_value());
}

}  // namespace
}  // namespace hri::htk
