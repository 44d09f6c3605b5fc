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

/// The frames that are searched, and those from which queries are drawn.
struct SearchLibrary {
  std::vector<Grades> frames;    ///< in time order
  std::vector<Grades> held_out;  ///< from further performances of the same clips
  GradeIndex index;
  std::string digest;  ///< of `frames`
};

/// Returns the digest of all grades in their order.
std::string DigestOf(std::span<const Grades> frames);

/// Makes a library of `frames` frames: the clips performed by dancers with varied tempo and amplitude (VariedLibrary of
/// sim/choreography). Needs at least one clip, each of at least two frames. The random draws are always the same,
/// because the library belongs to the condition; only queries differ between worlds. A smaller library is the beginning
/// of a larger one.
SearchLibrary MakeSearchLibrary(const ClipLibrary& clips, const FuzzySystem& fuzzy, int frames);

/// Draws `queries` frames from all held-out frames of the library.
std::vector<Grades> DrawQueries(const SearchLibrary& library, int queries, const WorldKey& key);

/// The library that the worlds of a condition share. It is made at the first request. Not thread-safe.
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
