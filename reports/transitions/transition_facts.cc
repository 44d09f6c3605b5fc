#include "reports/transitions/transition_facts.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"

namespace etude {
namespace {

std::string TextOf(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<double> NumberOf(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

// Larger values are not frame numbers and would overflow when added.
std::optional<int> FrameOf(const Json& json) {
  constexpr long long kMost = 100'000'000;
  if (!json.is_number_integer()) return std::nullopt;
  const auto frame = json.get<long long>();
  return frame >= -kMost && frame <= kMost ? std::optional(static_cast<int>(frame)) : std::nullopt;
}
std::optional<int> FrameOf(const Json& json, const char* key) { return FrameOf(json.value(key, Json())); }

std::optional<long long> CountOf(const Json& json, const char* key) {
  const Json count = json.value(key, Json());
  return count.is_number_integer() ? std::optional(count.get<long long>()) : std::nullopt;
}

/// One number for each of the ten features, or nothing.
std::optional<PerFeature> FeaturesOf(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_object()) return std::nullopt;
  PerFeature values{};
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    const auto value = NumberOf(*found, std::string(FeatureName(AllFeatures()[k])).c_str());
    if (!value) return std::nullopt;
    values[k] = *value;
  }
  return values;
}

/// The objects of a list; none when there is no such list.
std::vector<Json> ObjectsOf(const Json& json, const char* key) {
  std::vector<Json> objects;
  const Json list = json.value(key, Json::array());
  if (!list.is_array()) return objects;
  std::ranges::copy_if(list, std::back_inserter(objects), [](const Json& entry) { return entry.is_object(); });
  return objects;
}

// "transition_frames" when the change went through an in-between clip, else "transition_frame"; those inside the
// motion.
std::vector<int> TransitionFramesOf(const Json& extras, int frames) {
  std::vector<int> points;
  const auto add = [&](const Json& json) {
    const auto point = FrameOf(json);
    if (point && *point >= 0 && *point < frames) points.push_back(*point);
  };
  const Json all = extras.value("transition_frames", Json::array());
  for (const Json& point : all.is_array() ? all : Json::array()) add(point);
  if (points.empty()) add(extras.value("transition_frame", Json()));
  std::ranges::sort(points);
  return points;
}

PointFacts PointOf(const Json& json) {
  return {.from = ClipInWords(TextOf(json, "from")),
          .to = ClipInWords(TextOf(json, "to")),
          .from_frame = FrameOf(json, "from_frame"),
          .to_frame = FrameOf(json, "to_frame"),
          .distance = NumberOf(json, "distance"),
          .partials = FeaturesOf(json, "partials")};
}

std::optional<CandidateFacts> CandidateOf(const Json& json) {
  const auto from = FrameOf(json, "from_frame"), to = FrameOf(json, "to_frame");
  const auto distance = NumberOf(json, "distance");
  if (!from || !to || !distance) return std::nullopt;
  return CandidateFacts{.from_frame = *from,
                        .to_frame = *to,
                        .distance = *distance,
                        .partials = FeaturesOf(json, "partials"),
                        .cost = NumberOf(json, "cost"),
                        .outcome = TextOf(json, "outcome"),
                        .point = FrameOf(json, "point")};
}

}  // namespace

Result<TransitionFacts> ReadTransitionFacts(const Recording& recording, const std::string& cell) {
  const Json extras = Json::parse(recording.extras_json, nullptr, false);
  if (!extras.is_object()) return Fail({.file = "recording " + cell}, "its extras are no JSON object");
  const BodyMotion* coach = FindTrack(recording, "coach");
  TransitionFacts facts;
  facts.from = ClipInWords(TextOf(extras, "from"));
  facts.to = ClipInWords(TextOf(extras, "to"));
  facts.branch = TextOf(extras, "branch");
  facts.why = TextOf(extras, "why");
  facts.cost_unit = TextOf(extras, "cost_unit");
  facts.transition_frames = TransitionFramesOf(extras, coach == nullptr ? 0 : static_cast<int>(coach->poses.size()));
  for (const Json& entry : ObjectsOf(extras, "transition_points")) facts.points.push_back(PointOf(entry));
  if (facts.points.empty()) facts.points.push_back(PointOf(extras));
  for (const Json& entry : ObjectsOf(extras, "candidates")) {
    if (auto candidate = CandidateOf(entry)) facts.candidates.push_back(*std::move(candidate));
  }
  facts.request_frame = FrameOf(extras, "request_frame");
  facts.wait_s = NumberOf(extras, "wait_s");
  facts.threshold = NumberOf(extras, "threshold");
  facts.natural_limit_cm = NumberOf(extras, "natural_limit_cm");
  facts.weights = FeaturesOf(extras, "weights");
  facts.pairs_seen = CountOf(extras, "pairs_seen");
  facts.pairs_matched = CountOf(extras, "pairs_matched");
  return facts;
}

std::string ClipInWords(std::string name) {
  constexpr std::string_view kBuiltin = "builtin:";
  if (name.starts_with(kBuiltin)) name.erase(0, kBuiltin.size());
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace etude
