#include "bench/clips/time_span.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "engine/base/names.h"
#include "engine/motion/edit.h"

namespace etude {
namespace {

bool ParseSeconds(std::string_view text, double& seconds) {
  if (text.empty()) return true;  // an open end
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(seconds) && seconds >= 0;
}

}  // namespace

Result<TimeSpan> ParseTimeSpan(const std::string& text) {
  TimeSpan span{0, std::numeric_limits<double>::infinity()};
  const std::size_t colon = text.find(':');
  const bool is_span = colon != std::string::npos &&
                       ParseSeconds(std::string_view(text).substr(0, colon), span.from_s) &&
                       ParseSeconds(std::string_view(text).substr(colon + 1), span.to_s);
  if (!is_span) {
    return Fail({}, "{} is no span of time; allowed: FROM:TO in seconds, such as 1.5:4, 2: or :3", Quote(text));
  }
  if (span.to_s < span.from_s) return Fail({}, "{} ends before it starts", Quote(text));
  return span;
}

Result<Clip> TrimTo(const Clip& clip, const std::optional<TimeSpan>& span) {
  if (!span) return clip;
  const bool is_open = span->to_s == std::numeric_limits<double>::infinity();
  return Trim(clip, span->from_s, is_open ? std::max(span->from_s, clip.DurationSeconds()) : span->to_s);
}

}  // namespace etude
