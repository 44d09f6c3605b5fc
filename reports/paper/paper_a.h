#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/fuzzy/defuzzify.h"
#include "engine/fuzzy/membership.h"

namespace etude {

/// The text under one of paper A's figures 5 to 10.
struct PaperAFigure {
  int number;
  Feature feature;  ///< of the right side; the left one's functions are the same
  const char* title;
  const char* input;           ///< what the axis shows
  std::vector<int> equations;  ///< one per term, in the order of TermsOf
  const char* repaired;        ///< what is misprinted or left open, "" for nothing
};
const std::vector<PaperAFigure>& PaperAFigures();

/// Computes the cost of going through the grades and back: the mean difference between an input and what a method makes
/// of its grades, over inputs spread evenly over the universe.
double MeanRoundTripError(Feature feature, const Memberships& memberships, Defuzzification method);

/// Draws the membership functions of one feature over its universe as an SVG element of the page: from GradeOf, each
/// term named at its peak, the axis marked where a straight-sided function bends.
std::string MembershipPlotSvg(Feature feature, const Memberships& memberships, const std::string& title);

/// Is true of paper A's own scenario (task transition, named `paper-bridging`) and of those that sweep the key `fuzzy`.
bool ShowsPaperA(const ScenarioSummary& scenario);

/// Writes figures 5 to 10 of paper A, drawn from the functions that grade poses, with what defuzzification makes of
/// their grades; beside them the program's other fuzzy systems, where the scenario sweeps them. "" where ShowsPaperA is
/// false.
std::string PaperAHtml(const ScenarioSummary& scenario);
/// Writes the functions as a table, folded away.
std::string PaperAMarkdown(const ScenarioSummary& scenario);
/// Writes them as a float of the package booktabs.
std::string PaperALatex(const ScenarioSummary& scenario);

}  // namespace etude
