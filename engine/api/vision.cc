#include <etude/vision.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "engine/vision/person_finder.h"

namespace etude::engine {
namespace {

constexpr int kMaxSide = 8192;

ColourImage ToPicture(std::span<const std::uint8_t> bytes, int width, int height) {
  const std::size_t wanted = std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (bytes.size() != wanted) {
    throw BadInput(fmt::format("a picture of {} bytes; allowed: {} x {} x 3", bytes.size(), width, height));
  }
  ColourImage picture(width, height);
  static_assert(sizeof(Rgb8) == 3);
  std::memcpy(picture.pixels.data(), bytes.data(), bytes.size());
  return picture;
}

PersonOptions ToEngineOptions(const PersonFinderOptions& options) {
  const std::vector<std::string> names = SegmenterNames();
  if (std::ranges::find(names, options.segmenter) == names.end()) {
    throw BadInput(fmt::format("no segmenter '{}'; allowed: {}", options.segmenter, fmt::join(names, ", ")));
  }
  PersonOptions told{.segmenter = SegmenterNamed(options.segmenter), .change = {}};
  told.pieces = options.all_pieces ? PersonPieces::kLarge : PersonPieces::kLargest;
  return told;
}

int Side(int length) {
  if (length >= 1 && length <= kMaxSide) return length;
  throw BadInput(fmt::format("a side of {} pixels; allowed: 1 to {}", length, kMaxSide));
}

}  // namespace

struct PersonFinder::State {
  int width, height;
  etude::PersonFinder finder;
};

PersonFinder::PersonFinder(std::span<const std::uint8_t> background, int width, int height,
                           const PersonFinderOptions& options)
    : state_(
          new State{Side(width), Side(height),
                    etude::PersonFinder(ToPicture(background, Side(width), Side(height)), ToEngineOptions(options))}) {}
PersonFinder::PersonFinder(PersonFinder&&) noexcept = default;
PersonFinder& PersonFinder::operator=(PersonFinder&&) noexcept = default;
PersonFinder::~PersonFinder() = default;

std::vector<std::uint8_t> PersonFinder::Find(std::span<const std::uint8_t> picture) {
  return state_->finder.Find(ToPicture(picture, state_->width, state_->height)).pixels;
}

}  // namespace etude::engine
