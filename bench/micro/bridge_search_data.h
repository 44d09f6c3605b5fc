#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/fuzzy/membership.h"
#include "engine/motion/body.h"

namespace etude {

/// The data of a search benchmark: the grades of performances with varied tempo and amplitude
/// (sim/choreography/varied_library.h) of built-in moves and acts and of captured clips.
struct SearchData {
  std::vector<std::vector<Grades>> clips;
  std::vector<Grades> frames;   ///< of all clips
  std::vector<Grades> own;      ///< queries: some of `frames`
  std::vector<Grades> varied;   ///< queries: other performances of the same seeds
  std::vector<Grades> foreign;  ///< queries: performances of seeds that are not in the library
};

struct SeedClip {
  std::string name;
  bool captured = false;  ///< motion capture; else one of the built-in moves and acts
  BodyMotion motion;
};

/// Loads the seeds: the built-in moves and acts, and `files` or else three captured clips of Debian's
/// assimp-testmodels, if installed. Ends the program if a file cannot be read.
std::vector<SeedClip> LoadSeeds(const std::vector<std::string>& files);

/// Lists the seeds in one line: names and numbers of frames; foreign seeds (every fifth) in brackets.
std::string DescribeSeeds(std::span<const SeedClip> seeds);

/// Makes a library of `count` frames from varied performances of the seeds. Every fifth seed is left out; its
/// performances are the foreign queries.
SearchData MakeSearchData(std::span<const SeedClip> seeds, int count);

/// Makes a library of the captured seeds, unchanged. It has no varied queries, because there are no other performances.
SearchData MakeCapturedData(std::span<const SeedClip> seeds);

/// Splits frames into clips of `length` frames; the rest is left out.
std::vector<std::vector<Grades>> ClipsOfLength(std::span<const Grades> frames, std::size_t length);

}  // namespace etude
