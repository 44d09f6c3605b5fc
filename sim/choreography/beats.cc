#include "sim/choreography/beats.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

constexpr double kShortestBeat = 0.2, kLongestBeat = 3;
constexpr std::size_t kFewestBeats = 8, kMostBeats = 10000;

std::string_view WithoutBlanks(std::string_view line) {
  const auto first = line.find_first_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view() : line.substr(first);
}

std::optional<double> NumberAtFront(std::string_view line) {
  double number = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  const bool is_whole = end == line.data() + line.size() || std::string_view(" \t\r,;").find(*end) != std::string::npos;
  return error == std::errc() && is_whole && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Between two beats in proportion.
double MomentOf(double beat, const std::vector<double>& beats_s) {
  const auto before = static_cast<std::size_t>(beat);
  const double share = beat - std::floor(beat);
  return share > 0 ? std::lerp(beats_s[before], beats_s[before + 1], share) : beats_s[before];
}

}  // namespace

Result<std::vector<double>> ReadBeats(std::string_view text, const std::string& file) {
  std::vector<double> beats;
  int number = 0;
  while (!text.empty()) {
    const std::string_view line = WithoutBlanks(text.substr(0, text.find('\n')));
    text.remove_prefix(std::min(text.size(), std::min(text.find('\n'), text.size() - 1) + 1));
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const auto moment = NumberAtFront(line);
    if (!moment) return Fail({file, number, 1}, "a beat is a number of seconds, found {}", Quote(line.substr(0, 40)));
    if (*moment < 0) return Fail({file, number, 1}, "a beat at {} s; must not be before 0", *moment);
    const double step = beats.empty() ? kShortestBeat : *moment - beats.back();
    if (step < kShortestBeat - 1e-9 || step > kLongestBeat) {
      return Fail({file, number, 1}, "a beat at {} s, {:.3f} s after the one before; allowed: {} to {}", *moment, step,
                  kShortestBeat, kLongestBeat);
    }
    beats.push_back(*moment);
    if (beats.size() > kMostBeats) return Fail({file, number, 1}, "more than {} beats", kMostBeats);
  }
  if (beats.size() < kFewestBeats) return Fail({file}, "{} beats; at least {}", beats.size(), kFewestBeats);
  return beats;
}

double TempoOf(const std::vector<double>& beats_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < beats_s.size(); ++i) steps.push_back(beats_s[i] - beats_s[i - 1]);
  // To a hundredth: digits of a file are no reason to call a tempo too fast for a move.
  return std::round(6000 / UpperMedian(std::move(steps))) / 100;
}

Result<Dance> ToBeats(Dance dance, const std::vector<double>& beats_s) {
  const double beats_per_s = dance.tempo_bpm / 60;
  const double last = static_cast<double>(dance.motion.poses.size() - 1) / kJudgedRateHz * beats_per_s;
  if (last > static_cast<double>(beats_s.size() - 1)) {
    return Fail({}, "{} beats; '{}' takes {:.0f} of them", beats_s.size(), dance.title, std::ceil(last) + 1);
  }
  for (MusicTag& tag : dance.tags) tag.music_s = MomentOf(tag.music_s * beats_per_s, beats_s);
  dance.beats_s = beats_s;
  return dance;
}

}  // namespace etude
