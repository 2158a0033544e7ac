// Usage: read_signs MODEL < TRACKS
// Signed sentences as they are signed, from any tracker that writes a line for every frame: its
// time in seconds, and x and y of the left hand, the right hand and the head in pixels, nan where
// one is out of sight. Builds with and without exceptions.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <hri/core/error.hpp>
#include <hri/recognition/sentence/sentence_stream.hpp>
#include <iostream>
#include <string>
#include <vector>

namespace {

// None if there is anything else in the line.
std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> result;
  const char* at = line.c_str();
  for (char* end = nullptr;; at = end) {
    const double value = std::strtod(at, &end);
    if (end == at) break;
    result.push_back(value);
  }
  if (at[std::strspn(at, " \t\r")] != '\0') return {};
  return result;
}

void print(const hri::SentenceEvent& event) {
  const bool ended = event.kind == hri::SentenceEventKind::end;
  if (!ended && event.kind != hri::SentenceEventKind::partial) return;
  // Words that may still change stand in brackets.
  std::printf(ended ? "sentence" : "so far");
  for (std::size_t i = 0; i < event.words.size(); ++i) {
    const bool stable = i < static_cast<std::size_t>(event.num_stable);
    std::printf(stable ? "\t%s" : "\t[%s]", event.words[i].label.c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

int run(const char* model) {
  hri::SentenceStream stream(hri::SentenceRecognizer::load(model));
  int number = 0;
  for (std::string line; std::getline(std::cin, line);) {
    ++number;
    const std::vector<double> values = numbers_of(line);
    if (values.size() != 7) {
      std::fprintf(stderr, "line %d: expected 7 numbers\n", number);
      return 3;
    }
    const std::vector<float> places(values.begin() + 1, values.end());
    print(stream.push(places, values[0]));
  }
  print(stream.finish());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s MODEL < TRACKS\n", argv[0]);
    return 2;
  }
  // Called in place of throwing by a core that is built with HRI_EXCEPTIONS=OFF.
  hri::set_failure_handler([](hri::ErrorKind, const char* message) {
    std::fprintf(stderr, "%s\n", message);
    std::exit(3);
  });
#ifdef __cpp_exceptions
  try {
    return run(argv[1]);
  } catch (const hri::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
#else
  return run(argv[1]);
#endif
}
