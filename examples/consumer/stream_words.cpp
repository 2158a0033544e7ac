// Usage: stream_words MODEL FILE.wav
// Words in a stream that arrives in blocks of 10 ms, as from a microphone or an interrupt handler.
// Builds with and without exceptions.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <hri/core/error.hpp>
#include <hri/io/wav.hpp>
#include <hri/recognition/word/word_recognizer.hpp>
#include <hri/signal/stream/endpointer.hpp>

namespace {

int run(const char* model, const char* file) {
  const auto recognizer = hri::WordRecognizer::load(model);
  const hri::Wav wav = hri::read_wav(file);
  const hri::Span<const float> stream(wav.samples);
  const auto rate_hz = static_cast<std::size_t>(wav.sample_rate_hz);

  hri::Endpointer endpointer(wav.sample_rate_hz, {});
  const auto decide = [&](const hri::Endpoint& event) {
    if (event.kind != hri::EndpointKind::speech_end) return;
    const auto segment =
        stream.subspan(event.segment_first, event.segment_last - event.segment_first);
    const hri::Decision decision = recognizer.recognise(segment, wav.sample_rate_hz);
    std::printf("%zu ms\t%s\t%.3f\n", 1000 * event.first / rate_hz, decision.label.c_str(),
                decision.confidence);
  };
  for (std::size_t at = 0; at < stream.size();) {
    hri::Endpoint event;
    at +=
        endpointer.consume(stream.subspan(at, std::min(rate_hz / 100, stream.size() - at)), &event);
    decide(event);
  }
  for (hri::Endpoint event = endpointer.finish(); event.kind != hri::EndpointKind::none;
       event = endpointer.finish()) {
    decide(event);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s MODEL FILE.wav\n", argv[0]);
    return 2;
  }
  // Called in place of throwing by a core that is built with HRI_EXCEPTIONS=OFF.
  hri::set_failure_handler([](hri::ErrorKind, const char* message) {
    std::fprintf(stderr, "%s\n", message);
    std::exit(3);
  });
#ifdef __cpp_exceptions
  try {
    return run(argv[1], argv[2]);
  } catch (const hri::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
#else
  return run(argv[1], argv[2]);
#endif
}
