#pragma once

#include <string>
#include <vector>

namespace etude {

/// One picture with the words that tell what it shows.
struct Picture {
  std::string png;  ///< bytes of a PNG file
  int width = 0;
  int height = 0;
  std::string caption;
};

/// What the recordings gave to look at, and plain words for what they did not.
struct Media {
  std::string mp4;          ///< bytes of the film; empty when there is none
  std::string why_no_film;  ///< set when `mp4` is empty
  std::string film_caption;
  Picture poster;              ///< png empty when nothing could be drawn
  std::vector<Picture> strip;  ///< moments of the capture: stereo pictures, mask, recovered skeleton
  std::string strip_scenario;  ///< whose card shows the strip
};

}  // namespace etude
