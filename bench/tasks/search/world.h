#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/fuzzy/fuzzy_system.h"
#include "engine/transitions/search/grade_index.h"
#include "io/clips/clip_library.h"
#include "sim/random/stream.h"

namespace etude {

/// The frames that are searched, and those that may be asked about.
struct SearchLibrary {
  std::vector<Grades> frames;    ///< in time order
  std::vector<Grades> held_out;  ///< of further performances of the same clips
  GradeIndex index;
  std::string digest;  ///< of the frames
};

/// The digest of all grades, in their order.
std::string DigestOf(std::span<const Grades> frames);

/// `frames` frames of the clips, performed by dancers whose tempo and amplitude vary (sim/choreography's VariedLibrary;
/// at least one clip, each of two frames at least). The dice are always the same: what is searched belongs to the
/// condition, only what is asked is a world's. A smaller library is the beginning of a larger one.
SearchLibrary MakeSearchLibrary(const ClipLibrary& clips, const FuzzySystem& fuzzy, int frames);

/// `queries` of the library's held-out frames, each drawn from all of them.
std::vector<Grades> DrawQueries(const SearchLibrary& library, int queries, const WorldKey& key);

/// The library that the worlds of a condition share, made when the first of them is. Not for several threads.
class SharedLibrary {
 public:
  SharedLibrary(ClipLibrary clips, FuzzySystem fuzzy, int frames)
      : clips_(std::move(clips)), fuzzy_(std::move(fuzzy)), frames_(frames) {}

  const SearchLibrary& Get() {
    if (!made_) made_ = MakeSearchLibrary(clips_, fuzzy_, frames_);
    return *made_;
  }

 private:
  const ClipLibrary clips_;
  const FuzzySystem fuzzy_;
  const int frames_;
  std::optional<SearchLibrary> made_;
};

}  // namespace etude
