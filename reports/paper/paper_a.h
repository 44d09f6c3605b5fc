#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/fuzzy/defuzzify.h"
#include "engine/fuzzy/membership.h"

namespace etude {

/// The caption of one of paper A's figures 5 to 10.
struct PaperAFigure {
  int number;
  Feature feature;  ///< a feature of the body's right side; the left side has the same membership functions
  const char* title;
  const char* input;           ///< the name of the quantity on the horizontal axis
  std::vector<int> equations;  ///< the paper's equation numbers, one per term, in the order of TermsOf
  const char* repaired;        ///< misprints or gaps of the paper that were repaired; "" if there are none
};
const std::vector<PaperAFigure>& PaperAFigures();

/// Returns the round-trip error of fuzzification and defuzzification: the mean absolute difference between an input and
/// the value that defuzzification recovers from the input's grades, over inputs spread evenly over the universe.
double MeanRoundTripError(Feature feature, const Memberships& memberships, Defuzzification method);

/// Draws the membership functions of one feature over its universe as an SVG element. The name of each term stands at
/// the term's peak. The axis has a tick wherever the slope of a piecewise linear function changes.
std::string MembershipPlotSvg(Feature feature, const Memberships& memberships, const std::string& title);

/// Returns true if the card of the scenario shows paper A's figures: for paper A's own scenario (task transition, named
/// `paper-bridging`), and for scenarios that sweep the key `fuzzy`.
bool ShowsPaperA(const ScenarioSummary& scenario);

/// Returns figures 5 to 10 of paper A, drawn from the membership functions that the program uses, with the inputs that
/// defuzzification recovers from the grades. If the scenario sweeps other fuzzy systems, their functions follow.
/// Returns "" if ShowsPaperA is false.
std::string PaperAHtml(const ScenarioSummary& scenario);
/// Returns the membership functions of the features as a collapsed Markdown table (<details>).
std::string PaperAMarkdown(const ScenarioSummary& scenario);
/// Returns the membership functions of the features as a LaTeX float for the package booktabs.
std::string PaperALatex(const ScenarioSummary& scenario);

}  // namespace etude
