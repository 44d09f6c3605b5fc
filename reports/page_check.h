#pragma once

#include <string_view>

namespace etude {

/// Marks around the parts of a page that cannot be reproduced from the run's rows alone: pictures and films with their
/// captions.
constexpr std::string_view kMediaBegin = "<!--media-->", kMediaEnd = "<!--/media-->";
/// Marks around the rows of captures of real films, which belong to no run.
constexpr std::string_view kTakesBegin = "<!--takes-->", kTakesEnd = "<!--/takes-->";

/// The result of comparing a page with the page made from its run.
struct PageCheck {
  bool same = false;                          ///< equal bytes outside the marks
  bool has_media = false, has_takes = false;  ///< true if the page has text, not compared, between such marks
};

/// Compares a page with `bare`, the same run's page with nothing between its marks. Between the marks the page may hold
/// any text, and the elements of pictures and films, or of rows of takes; each element must be closed between the same
/// marks. A style, a script or anything that reaches beyond the marks makes the pages differ.
PageCheck CheckPage(std::string_view page, std::string_view bare);

}  // namespace etude
