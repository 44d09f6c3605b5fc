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
  Feature feature;  ///< the figure shows the right side; the left side has the same functions
  const char* title;
  const char* input;           ///< the quantity on the axis
  std::vector<int> equations;  ///< one per term, in the order of TermsOf
  const char* repaired;        ///< misprints or gaps of the paper that were repaired; "" if there are none
};
const std::vector<PaperAFigure>& PaperAFigures();

/// Returns the round-trip error of fuzzification and defuzzification: the mean absolute difference between an input and
/// the value defuzzified from its grades, over inputs spread evenly over the universe.
double MeanRoundTripError(Feature feature, const Memberships& memberships, Defuzzification method);

/// Draws the membership functions of one feature over its universe as an SVG element. Each term is named at its peak;
/// the axis has a mark where a piecewise linear function bends.
std::string MembershipPlotSvg(Feature feature, const Memberships& memberships, const std::string& title);

/// Returns true for paper A's own scenario (task transition, named `paper-bridging`), and for scenarios that sweep the
/// key `fuzzy`.
bool ShowsPaperA(const ScenarioSummary& scenario);

/// Returns figures 5 to 10 of paper A, drawn from the functions that grade poses, with the values that defuzzification
/// recovers from the grades; then the program's other fuzzy systems, if the scenario sweeps them. Returns "" if
/// ShowsPaperA is false.
std::string PaperAHtml(const ScenarioSummary& scenario);
/// Returns the membership functions as a folded Markdown table.
std::string PaperAMarkdown(const ScenarioSummary& scenario);
/// Returns the membership functions as a LaTeX float for the package booktabs.
std::string PaperALatex(const ScenarioSummary& scenario);

}  // namespace etude
