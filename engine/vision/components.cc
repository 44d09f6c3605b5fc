#include "engine/vision/components.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

namespace etude {
namespace {

using Run = Components::Run;

struct RunsOfMask {
  std::vector<Run> runs;
  std::vector<bool> set;  // for each run: true if its pixels are 1
};

// Returns the end of the run that begins at x. Compares eight pixels at a time, because runs are long.
int EndOfRun(const std::uint8_t* row, int x, int width) {
  constexpr int kBlock = sizeof(std::uint64_t);
  const std::uint8_t value = row[x];
  const std::uint64_t equal = value * std::uint64_t{0x0101010101010101};
  for (std::uint64_t block = 0; x + kBlock <= width; x += kBlock) {
    std::memcpy(&block, row + x, kBlock);
    if (block != equal) break;
  }
  while (x < width && (row[x] != 0) == (value != 0)) ++x;
  return x;
}

RunsOfMask FindRuns(const Mask& mask) {
  RunsOfMask found;
  constexpr std::size_t kUsualRunsInARow = 8;
  found.runs.reserve(kUsualRunsInARow * static_cast<std::size_t>(mask.height));
  found.set.reserve(found.runs.capacity());
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* row = mask.pixels.data() + static_cast<std::ptrdiff_t>(y) * mask.width;
    for (int x = 0; x < mask.width;) {
      const bool set = row[x] != 0;
      const int begin = x;
      x = EndOfRun(row, x, mask.width);
      found.runs.push_back({y, begin, x, 0});
      found.set.push_back(set);
    }
  }
  return found;
}

void Paint(const Run& run, std::uint8_t value, Mask& mask) {
  std::fill_n(&mask.At(run.begin, run.row), run.end - run.begin, value);
}

// Union-find in which a set's smallest index represents the set. Components are therefore numbered in scan order,
// whatever the order of the joins.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::size_t Find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::size_t a, std::size_t b) {
    a = Find(a);
    b = Find(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<std::size_t> parent_;
};

// Joins every run with the runs of the same value that it touches in the row above. `above` and `below` advance
// together through the runs of the two rows, so each pair of touching runs is visited once.
void JoinRows(const RunsOfMask& found, Connectivity connectivity, Sets& sets) {
  const std::vector<Run>& runs = found.runs;
  std::size_t above = 0;
  for (std::size_t below = 0; below < runs.size(); ++below) {
    const Run& run = runs[below];
    while (runs[above].row < run.row - 1) ++above;
    while (runs[above].row == run.row - 1 && runs[above].end < run.begin) ++above;
    const bool by_corner = (connectivity == Connectivity::kEight) == found.set[below];
    const int reach = by_corner ? 1 : 0;
    for (std::size_t i = above; runs[i].row == run.row - 1 && runs[i].begin < run.end + reach; ++i) {
      if (found.set[i] == found.set[below] && run.begin < runs[i].end + reach) sets.Join(i, below);
    }
  }
}

// Returns the index of the largest component of 1s; of equally large components, the first in scan order. Returns the
// number of components if no pixel is set.
std::size_t IndexOfLargest(const Components& components) {
  std::size_t largest = components.pieces.size();
  int size = 0;
  for (std::size_t i = 0; i < components.pieces.size(); ++i) {
    if (!components.pieces[i].set || components.pieces[i].size <= size) continue;
    largest = i;
    size = components.pieces[i].size;
  }
  return largest;
}

// The bounding box of a component; right and bottom are exclusive.
struct Box {
  int left, top, right, bottom;

  void Include(const Run& run) {
    left = std::min(left, run.begin);
    right = std::max(right, run.end);
    top = std::min(top, run.row);
    bottom = std::max(bottom, run.row + 1);
  }
  bool IsWithin(int reach, const Box& other) const {
    return left < other.right + reach && right > other.left - reach && top < other.bottom + reach &&
           bottom > other.top - reach;
  }
};

Components LabelRuns(RunsOfMask found, int width, int height, Connectivity connectivity) {
  Sets sets(found.runs.size());
  JoinRows(found, connectivity, sets);

  Components components;
  components.runs = std::move(found.runs);
  for (std::size_t i = 0; i < components.runs.size(); ++i) {
    Run& run = components.runs[i];
    const std::size_t first = sets.Find(i);
    run.piece = first == i ? components.pieces.size() : components.runs[first].piece;
    if (first == i) components.pieces.push_back({found.set[i], 0, false});
    Components::Piece& piece = components.pieces[run.piece];
    piece.size += run.end - run.begin;
    piece.touches_border |= run.row == 0 || run.row == height - 1 || run.begin == 0 || run.end == width;
  }
  return components;
}

/// Returns the runs of a mask in which only this component of 1s is set.
RunsOfMask RunsOfPiece(const Components& components, std::size_t piece) {
  RunsOfMask kept;
  kept.runs.reserve(components.runs.size());
  for (const Run& run : components.runs) {
    const bool set = run.piece == piece;
    if (!set && !kept.runs.empty() && !kept.set.back() && kept.runs.back().row == run.row) {
      kept.runs.back().end = run.end;
    } else {
      kept.runs.push_back({run.row, run.begin, run.end, 0});
      kept.set.push_back(set);
    }
  }
  return kept;
}

}  // namespace

Components LabelComponents(const Mask& mask, Connectivity connectivity) {
  return LabelRuns(FindRuns(mask), mask.width, mask.height, connectivity);
}

Mask LargestComponent(const Mask& mask) {
  const Components components = LabelComponents(mask);
  const std::size_t largest = IndexOfLargest(components);
  Mask result(mask.width, mask.height);
  for (const Run& run : components.runs) {
    if (run.piece == largest) Paint(run, 1, result);
  }
  return result;
}

Mask LargeComponents(const Mask& mask, int smallest, int reach) {
  const Components components = LabelComponents(mask);
  const std::size_t largest = IndexOfLargest(components);
  Mask result(mask.width, mask.height);
  if (largest == components.pieces.size()) return result;
  std::vector<Box> boxes(components.pieces.size(), Box{mask.width, mask.height, 0, 0});
  for (const Run& run : components.runs) boxes[run.piece].Include(run);
  const Box& main = boxes[largest];
  for (const Run& run : components.runs) {
    const Components::Piece& piece = components.pieces[run.piece];
    const bool is_part = run.piece == largest || (piece.size >= smallest && boxes[run.piece].IsWithin(reach, main));
    if (piece.set && is_part) Paint(run, 1, result);
  }
  return result;
}

Mask FillHoles(const Mask& mask, int max_hole_px) {
  const Components components = LabelComponents(mask);
  Mask result = mask;
  for (const Run& run : components.runs) {
    const Components::Piece& piece = components.pieces[run.piece];
    if (!piece.set && !piece.touches_border && piece.size <= max_hole_px) Paint(run, 1, result);
  }
  return result;
}

void KeepPerson(Mask& mask, int max_hole_px) {
  const Components components = LabelComponents(mask);
  const std::size_t largest = IndexOfLargest(components);
  for (const Run& run : components.runs) {
    if (run.piece != largest && components.pieces[run.piece].set) Paint(run, 0, mask);
  }
  // Label the remaining mask from its runs, without reading the pixels again.
  const Components person = LabelRuns(RunsOfPiece(components, largest), mask.width, mask.height, Connectivity::kEight);
  for (const Run& run : person.runs) {
    const Components::Piece& piece = person.pieces[run.piece];
    if (!piece.set && !piece.touches_border && piece.size <= max_hole_px) Paint(run, 1, mask);
  }
}

}  // namespace etude
