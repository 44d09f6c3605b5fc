#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/fuzzy/membership.h"
#include "engine/motion/body.h"

namespace etude {

/// The data that searches are measured on: the grades of clips that were danced with varied tempo and amplitude
/// (sim/choreography/varied_library.h), out of the built-in moves and acts and real clips.
struct SearchData {
  std::vector<std::vector<Grades>> clips;
  std::vector<Grades> frames;   ///< of all clips
  std::vector<Grades> own;      ///< queries: some of `frames`
  std::vector<Grades> varied;   ///< queries: of other performances of the same seeds
  std::vector<Grades> foreign;  ///< queries: of seeds that the library does not know
};

struct SeedClip {
  std::string name;
  bool captured = false;  ///< motion capture; else one of the built-in moves and acts
  BodyMotion motion;
};

/// Motions to search in. `files`: clips instead of the real ones of Debian's assimp-testmodels. Ends the program if one
/// cannot be read; goes without the real ones where they are not installed.
std::vector<SeedClip> LoadSeeds(const std::vector<std::string>& files);

/// Describes in a line what a library is made of: names and numbers of frames, those that stay out of it (every fifth)
/// in brackets.
std::string MakeUp(std::span<const SeedClip> seeds);

/// A library of `count` frames: the seeds varied. Every fifth seed stays out of it and gives the foreign queries.
SearchData MakeSearchData(std::span<const SeedClip> seeds, int count);

/// The captured seeds as they are, every frame once. There are no other performances of them: no varied queries.
SearchData MakeCapturedData(std::span<const SeedClip> seeds);

/// The clips cut off and put together to clips of `length` frames each.
std::vector<std::vector<Grades>> ClipsOfLength(std::span<const Grades> frames, std::size_t length);

}  // namespace etude
