// Usage: print_scores MODEL FILE.wav
// The raw score of every label in hexadecimal, so that they can be compared with Python's to the
// bit.
#include <cstdio>
#include <hri/core/error.hpp>
#include <hri/io/wav.hpp>
#include <hri/recognition/word/word_recognizer.hpp>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s MODEL FILE.wav\n", argv[0]);
    return 2;
  }
  try {
    const auto recognizer = hri::WordRecognizer::load(argv[1]);
    const hri::Wav wav = hri::read_wav(argv[2]);
    const hri::VectorF scores = recognizer.scores(wav.samples, wav.sample_rate_hz);
    for (Eigen::Index i = 0; i < scores.size(); ++i) {
      std::printf("%s\t%a\n", recognizer.labels()[static_cast<std::size_t>(i)].c_str(),
                  static_cast<double>(scores[i]));
    }
  } catch (const hri::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
