// Usage: recognise_gesture MODEL VIDEO
// Video in, decision out: the label, its confidence, and the scores in hexadecimal, so that they
// can be compared with Python's to the bit.
#include <cstdio>
#include <hri/core/error.hpp>
#include <hri/recognition/gesture/gesture_recognizer.hpp>
#include <hri/vision/hand_finder.hpp>
#include <hri/vision/video.hpp>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s MODEL VIDEO\n", argv[0]);
    return 2;
  }
  try {
    const auto recognizer = hri::GestureRecognizer::load(argv[1]);
    const hri::HandFinder hands(recognizer.options().hands);
    const std::vector<hri::VideoFrame> clip = hri::read_video(argv[2]);
    const hri::Decision decision = recognizer.recognise(hri::views_of(clip), hands);
    std::printf("%s\t%a\t%a\n", decision.label.c_str(), static_cast<double>(decision.confidence),
                static_cast<double>(decision.score));
    for (const hri::NBest& entry : decision.nbest) {
      std::printf("%s\t%a\t%a\n", entry.label.c_str(), static_cast<double>(entry.probability),
                  static_cast<double>(entry.log_score));
    }
  } catch (const hri::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
