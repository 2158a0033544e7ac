// Usage: recognise_word MODEL FILE.wav
#include <hri/io/wav.hpp>
#include <hri/recognition/word/word_recognizer.hpp>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto recognizer = hri::WordRecognizer::load(argv[1]);
  const hri::Wav wav = hri::read_wav(argv[2]);
  const hri::Decision decision = recognizer.recognise(wav.samples, wav.sample_rate_hz);
  std::cout << decision.label << ' ' << decision.confidence << '\n';
}
