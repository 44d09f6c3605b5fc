#pragma once

#include <string_view>

namespace etude {

/// These HTML comments enclose the parts of a page that cannot be reproduced from the run's rows alone: pictures and
/// films, with captions.
constexpr std::string_view kMediaBegin = "<!--media-->", kMediaEnd = "<!--/media-->";
/// These HTML comments enclose the table rows about captures of real films, which do not come from the run.
constexpr std::string_view kTakesBegin = "<!--takes-->", kTakesEnd = "<!--/takes-->";

/// The result of comparing a page with the page made from its run.
struct PageCheck {
  bool same = false;                          ///< true if both pages have the same bytes outside the enclosed parts
  bool has_media = false, has_takes = false;  ///< true if the page has such an enclosed part, which is not compared
};

/// Compares a page with `bare`, the page of the same run with empty enclosed parts. A part between kMediaBegin and
/// kMediaEnd may contain text and the HTML elements of pictures, films and captions; a part between kTakesBegin and
/// kTakesEnd may contain text and table rows. Each element must be closed within its part. The pages count as
/// different if a style, a script or anything else in an enclosed part could affect the rest of the page.
PageCheck CheckPage(std::string_view page, std::string_view bare);

}  // namespace etude
