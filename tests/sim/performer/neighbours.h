#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/choreography/canonical_body.h"
#include "sim/performer/rendition.h"
#include "tests/sim/performer/all_moves.h"
#include "tests/sim/performer/clip_distance.h"

namespace etude {

struct PerformedClip {
  NormalisedClip clip;
  double duration_s = 0;
};

/// Returns one performance of every move by one person, with the intended execution.
inline std::vector<PerformedClip> EveryMoveOf(int number, People people) {
  const WorldKey key{11, "fidelity", number};
  const Person person = DrawPerson(key, people);
  RandomStream dice(key, "chances");
  std::vector<PerformedClip> clips;
  for (const Move& move : AllMoves()) {
    const Style style(person, move);
    const Chance chance = DrawChance(dice, person);
    const Rendition rendition(style, chance, {});
    const double duration = move.beats * 60 / (move.tempo_bpm * chance.tempo);
    std::vector<BodyPose> poses;
    for (double t = 0; t < duration; t += 1 / kJudgedRateHz) {
      poses.push_back(PoseOf(rendition.Danced(rendition.DancedShare(t / duration)), person.body));
    }
    clips.push_back({Normalised(poses), duration});
  }
  return clips;
}

/// The scores of a one-nearest-neighbour classifier on everybody's moves. It knows one clip of each move by one other
/// person.
struct Neighbours {
  double found = 0;                               ///< share of clips nearest to their own move
  std::vector<double> same_cm, nearest_other_cm;  ///< distances, sorted
  double duration_variation = 0;                  ///< coefficient of variation over people, mean over moves

  static double Quantile(const std::vector<double>& sorted, double q) {
    return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
  }
};

/// Scores `count` people; each is classified by `teachers` others.
inline Neighbours MeasureNeighbours(People people, int count, int teachers) {
  std::vector<std::vector<PerformedClip>> crowd;
  for (int i = 0; i < count; ++i) crowd.push_back(EveryMoveOf(i, people));
  Neighbours result;
  const std::size_t moves = AllMoves().size(), size = crowd.size();
  for (std::size_t p = 0; p < size; ++p) {
    for (std::size_t k = 1; k <= static_cast<std::size_t>(teachers); ++k) {
      const auto& taught = crowd[(p + k) % size];
      for (std::size_t m = 0; m < moves; ++m) {
        double same = 0, other = std::numeric_limits<double>::infinity();
        for (std::size_t n = 0; n < moves; ++n) {
          const double distance = WarpedDistanceCm(crowd[p][m].clip, taught[n].clip);
          n == m ? same = distance : other = std::min(other, distance);
        }
        result.same_cm.push_back(same);
        result.nearest_other_cm.push_back(other);
        result.found += same < other;
      }
    }
  }
  result.found /= static_cast<double>(result.same_cm.size());
  std::ranges::sort(result.same_cm);
  std::ranges::sort(result.nearest_other_cm);
  for (std::size_t m = 0; m < moves; ++m) {
    double mean = 0, square = 0;
    for (const auto& clips : crowd) {
      mean += clips[m].duration_s / count;
      square += clips[m].duration_s * clips[m].duration_s / count;
    }
    result.duration_variation += std::sqrt(square - mean * mean) / mean / static_cast<double>(moves);
  }
  return result;
}

}  // namespace etude
