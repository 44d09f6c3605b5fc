#include "reports/page_check.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace etude {
namespace {

constexpr std::string_view kDigits = "0123456789";
constexpr std::string_view kBase64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=";
// Maximum digits of a picture's width or height, so that a picture stays within the page.
constexpr std::size_t kMaxDigits = 4;

/// An HTML element that is allowed in an enclosed part (kMediaBegin, kTakesBegin), and its allowed attributes.
struct Element {
  std::string_view name;
  /// "class=film" allows only this value; "alt=" allows every value that IsAllowedValue accepts
  std::vector<std::string_view> attributes = {};
  bool is_void = false;  ///< true if the element has no closing tag
};

using Elements = std::span<const Element>;

const std::vector<Element>& MediaElements() {
  static const std::vector<Element> elements = {
      {"details"},
      {"summary"},
      {"figure", {"class=film"}},
      {"figcaption"},
      {"div", {"class=strip"}},
      {"p", {"class=quiet"}},
      {"a", {"href="}},
      {"img", {"width=", "height=", "alt=", "src="}, true},
      {"video",
       {"controls", "loop", "muted", "playsinline", "autoplay", "width=", "height=", "poster=", "src=", "aria-label="}},
  };
  return elements;
}

const std::vector<Element>& TakeElements() {
  static const std::vector<Element> elements = {{"tr"}, {"td", {"class=n"}}};
  return elements;
}

bool IsOf(std::string_view letters, std::string_view text) {
  return text.find_first_not_of(letters) == std::string_view::npos;
}

bool IsData(std::string_view value, std::string_view type) {
  return value.starts_with(type) && IsOf(kBase64, value.substr(type.size()));
}

/// Returns true if an attribute of this name may have this value.
bool IsAllowedValue(std::string_view name, std::string_view value) {
  constexpr std::string_view kFilms = "../video/";
  if (name == "alt" || name == "aria-label") return true;
  if (name == "width" || name == "height") return value.size() <= kMaxDigits && IsOf(kDigits, value);
  if (name == "href") return value.starts_with(kFilms) && value.find('/', kFilms.size()) == std::string_view::npos;
  return std::ranges::any_of(std::array{"data:image/png;base64,", "data:image/jpeg;base64,", "data:video/mp4;base64,"},
                             [&](const char* type) { return IsData(value, type); });
}

/// Removes ' name="value"' or ' name' from the front of `tag`. Returns true if the element allows this attribute, false
/// if the element does not allow it, and nullopt if the text is malformed.
std::optional<bool> TakeAttribute(std::string_view& tag, const Element& element) {
  tag.remove_prefix(1);
  const std::size_t end = std::min(tag.find_first_of("= "), tag.size());
  const std::string_view name = tag.substr(0, end);
  tag.remove_prefix(end);
  std::string_view value;
  const bool has_value = tag.starts_with("=\"");
  if (has_value) {
    const std::size_t close = tag.find('"', 2);
    if (close == std::string_view::npos) return {};
    value = tag.substr(2, close - 2);
    tag.remove_prefix(close + 1);
  }
  if (!tag.empty() && tag[0] != ' ') return {};
  return std::ranges::any_of(element.attributes, [&](std::string_view allowed) {
    const std::size_t sign = allowed.find('=');
    if (allowed.substr(0, sign) != name || (sign != std::string_view::npos) != has_value) return false;
    if (!has_value) return true;
    const std::string_view wanted = allowed.substr(sign + 1);
    return wanted.empty() ? IsAllowedValue(name, value) : wanted == value;
  });
}

/// Returns the allowed element that a tag opens; `tag` is the tag without brackets. Returns null if the element or one
/// of its attributes is not allowed.
const Element* FindOpened(std::string_view tag, Elements elements) {
  const std::string_view name = tag.substr(0, tag.find(' '));
  const auto found = std::ranges::find(elements, name, &Element::name);
  if (found == elements.end()) return nullptr;
  tag.remove_prefix(name.size());
  while (!tag.empty()) {
    if (!TakeAttribute(tag, *found).value_or(false)) return nullptr;
  }
  return &*found;
}

/// Returns true if a text opens only these elements, and closes each element that it opens.
bool HoldsOnly(std::string_view html, Elements elements) {
  std::vector<std::string_view> open;
  for (std::size_t at = html.find('<'); at != std::string_view::npos; at = html.find('<', at)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string_view::npos) return false;
    const std::string_view tag = html.substr(at + 1, end - at - 1);
    at = end + 1;
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
      continue;
    }
    const Element* element = FindOpened(tag, elements);
    if (element == nullptr) return false;
    if (!element->is_void) open.push_back(element->name);
  }
  return open.empty();
}

}  // namespace

PageCheck CheckPage(std::string_view page, std::string_view bare) {
  PageCheck check;
  while (true) {
    const std::size_t media = bare.find(kMediaBegin), takes = bare.find(kTakesBegin);
    if (media == takes) break;  // both are npos: `bare` contains no further part between these marks
    const bool is_media = media < takes;
    const std::string_view end = is_media ? kMediaEnd : kTakesEnd;
    const std::size_t before = is_media ? media + kMediaBegin.size() : takes + kTakesBegin.size();
    if (page.substr(0, before) != bare.substr(0, before)) return check;
    page.remove_prefix(before);
    bare.remove_prefix(before);
    const std::string_view between = page.substr(0, page.find(end));
    if (!HoldsOnly(between, is_media ? MediaElements() : TakeElements())) return check;
    (is_media ? check.has_media : check.has_takes) |= !between.empty();
    page.remove_prefix(between.size());
  }
  check.same = page == bare;
  return check;
}

}  // namespace etude
