// Usage: stream_words MODEL FILE.wav
// Words in a stream that arrives in blocks of 10 ms, as from a microphone or an interrupt handler.
// Builds with and without exceptions.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <hri/core/error.hpp>
#include <hri/io/wav.hpp>
#include <hri/recognition/word/word_recognizer.hpp>
#include <hri/signal/endpointer.hpp>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  // Only called by a core that is built with HRI_EXCEPTIONS=OFF.
  hri::set_failure_handler([](hri::ErrorKind, const char* message) {
    std::fprintf(stderr, "%s\n", message);
    std::exit(3);
  });
  const auto recognizer = hri::WordRecognizer::load(argv[1]);
  const hri::Wav wav = hri::read_wav(argv[2]);
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
}
