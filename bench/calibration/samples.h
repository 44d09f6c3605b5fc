#pragma once

#include <string_view>

#include "bench/statistics/beyond.h"
#include "sim/random/stream.h"

namespace etude {

/// How differences of worlds are distributed. Without an effect each is symmetric around zero.
enum class SampleLaw {
  kNormal,
  kHeavyTailed,  ///< Student's t of 3 degrees of freedom
  kTies,         ///< normal, but six worlds of ten show no difference
  kShares,       ///< of 0/1 values: −1, 0 or 1
  kCensored,     ///< penalised costs (PAR-2): log-normal, three of ten beyond the limit and counted twice
};
inline constexpr int kSampleLaws = 5;
std::string_view SampleLawName(SampleLaw law);

/// A sample to be drawn.
struct SampleDesign {
  SampleLaw law = SampleLaw::kNormal;
  int units = 6;
  int trials = 1;    ///< worlds per unit; with `in_pairs` worlds in all
  double alike = 0;  ///< correlation of two worlds of one unit, 0…1 (of kTies and kCensored before ties and limit)
  bool in_pairs = false;  ///< a world is drawn from two units, in two parts that bring half of the correlation each …
  double part_alike = 0;  ///< … and which correlate by so much for one unit
};

/// A difference that just matters, in the sample's own unit: a third of the worlds' standard deviation; of shares and
/// penalised costs a sixth, for four times as much must still be possible.
double JustMatters(SampleLaw law);

/// Draws a sample whose true mean difference is `effect` × JustMatters.
UnitSample DrawSample(const SampleDesign& design, double effect, RandomStream& dice);

}  // namespace etude
