// Usage: watch_video MODEL VIDEO
// A video as a stream: what is shown in it, as it is shown. A robot obeys final decisions.
#include <cstdio>
#include <hri/core/error.hpp>
#include <hri/recognition/gesture/gesture_stream.hpp>
#include <hri/vision/hand_finder.hpp>
#include <hri/vision/video.hpp>

namespace {

void print(const std::vector<hri::GestureEvent>& events) {
  for (const hri::GestureEvent& event : events) {
    if (event.kind != hri::GestureEventKind::preliminary &&
        event.kind != hri::GestureEventKind::decision)
      continue;
    const bool final = event.kind == hri::GestureEventKind::decision;
    std::printf("%s\t%.4f\t%.4f\t%s\t%a\n", final ? "decision" : "preliminary",
                event.segment.first_s, event.segment.last_s, event.decision.label.c_str(),
                static_cast<double>(event.decision.score));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s MODEL VIDEO\n", argv[0]);
    return 2;
  }
  try {
    const auto recognizer = hri::GestureRecognizer::load(argv[1]);
    hri::GestureStream stream(recognizer, hri::HandFinder(recognizer.options().hands));
    hri::VideoReader video(argv[2]);
    for (hri::VideoFrame frame; video.read(&frame);) print(stream.push(frame.view(), frame.time_s));
    print(stream.finish());
  } catch (const hri::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
