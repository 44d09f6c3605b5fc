#pragma once

#include <span>
#include <vector>

#include "engine/fuzzy/defuzzify.h"
#include "engine/fuzzy/membership.h"

namespace etude {

/// What stands under one of paper A's figures 5 to 10.
struct PaperAFigure {
  int number;
  Feature feature;  ///< of the right side; the left one's functions are the same
  const char* title;
  const char* input;           ///< what the axis shows
  std::vector<int> equations;  ///< one per term, in the order of TermsOf
  const char* repaired;        ///< what is misprinted or left open, "" for nothing
};
const std::vector<PaperAFigure>& PaperAFigures();

/// What going through the grades and back costs: the mean difference between an input and what a method makes of its
/// grades, over inputs spread evenly over the universe.
double MeanRoundTripError(Feature feature, const Memberships& memberships, Defuzzification method);

}  // namespace etude
