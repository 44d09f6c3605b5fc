#pragma once

#include <etude/base.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace etude::engine {

struct PersonFinderOptions {
  std::string segmenter = "hue-gated";  ///< or "rgb", "hue", "ratio", "likelihood", "running" (needs no empty room)
  /// True: the person is the largest changed piece together with all large pieces near it; false: the largest piece
  /// alone.
  bool all_pieces = false;
};

/// Cuts the person out of one camera's pictures, one after the other.
class ETUDE_API PersonFinder {
 public:
  /// @param background the empty room: width × height × 3 bytes, red, green, blue, row by row from the top. Throws
  /// BadInput for another number of bytes, a side that is not from 1 to 8192, and an unknown segmenter.
  PersonFinder(std::span<const std::uint8_t> background, int width, int height,
               const PersonFinderOptions& options = {});
  PersonFinder(PersonFinder&&) noexcept;
  PersonFinder& operator=(PersonFinder&&) noexcept;
  ~PersonFinder();

  /// Finds the person in the next picture: width × height bytes, 1 for the person, else 0. Throws BadInput for a
  /// picture of another size.
  std::vector<std::uint8_t> Find(std::span<const std::uint8_t> picture);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace etude::engine
