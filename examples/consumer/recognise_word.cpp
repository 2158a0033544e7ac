// Usage: recognise_word MODEL FILE.wav [EMBEDDING.onnx]
// The third is the file of the speech embedding, for a model that was trained with one.
#include <hri/io/wav.hpp>
#include <hri/recognition/word/word_recognizer.hpp>
#include <iostream>

void print_word(const char* model, const char* file,
                std::shared_ptr<const hri::SpeechEmbedding> embedding = nullptr) {
  const auto recognizer = hri::WordRecognizer::load(model, std::move(embedding));
  const hri::Wav wav = hri::read_wav(file);
  const hri::Decision decision = recognizer.recognise(wav.samples, wav.sample_rate_hz);
  std::cout << decision.label << ' ' << decision.confidence << '\n';
}

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::cerr << "usage: " << argv[0] << " MODEL FILE.wav [EMBEDDING.onnx]\n";
    return 2;
  }
  try {
    std::shared_ptr<const hri::SpeechEmbedding> embedding;
    if (argc == 4) {
      embedding = std::make_shared<hri::SpeechEmbedding>(hri::SpeechEmbedding::load(argv[3]));
    }
    print_word(argv[1], argv[2], std::move(embedding));
  } catch (const hri::Error& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
  return 0;
}
