#pragma once

#include <string_view>

namespace etude {

/// Opens and closes, in a page, what cannot be made from its run at once: pictures and films with their captions.
constexpr std::string_view kMediaBegin = "<!--media-->", kMediaEnd = "<!--/media-->";
/// Opens and closes, in a page, the rows of captures of real films, which are of no run.
constexpr std::string_view kTakesBegin = "<!--takes-->", kTakesEnd = "<!--/takes-->";

/// A page held against what its run makes.
struct PageCheck {
  bool same = false;                          ///< outside of the marks, by the byte
  bool has_media = false, has_takes = false;  ///< something stands between such marks, which nobody has compared
};

/// Compares a page with the same run's page that has nothing between its marks. Between them a page may hold nothing
/// but the elements of pictures and films, or rows of takes, with any text, each closed where it was opened: no style,
/// no script, nothing that reaches beyond them.
PageCheck CheckPage(std::string_view page, std::string_view bare);

}  // namespace etude
