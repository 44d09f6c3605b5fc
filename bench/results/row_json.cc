#include "bench/results/row_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/metrics/catalogue.h"
#include "bench/model/recording.h"
#include "engine/base/text.h"

namespace etude {
namespace {

constexpr std::string_view kDigestPrefix = "digest_";

/// Returns a swept value as a number if its text is a number, so that readers of rows can plot it; otherwise as text.
Json ValueAsJson(const std::string& text) {
  if (const auto number = ParseFinite(text)) return *number;
  return text;
}

std::vector<SweptValue> SplitCondition(const std::string& label) {
  std::vector<SweptValue> settings;
  for (std::size_t at = 0; at < label.size() && label != "-";) {
    const std::size_t end = std::min(label.find(',', at), label.size());
    const std::size_t equals = label.find('=', at);
    if (equals == std::string::npos || equals > end) break;
    settings.push_back({label.substr(at, equals - at), label.substr(equals + 1, end - equals - 1)});
    at = end + 1;
  }
  return settings;
}

}  // namespace

Json EncodeJudged(const JudgedOn& judged) {
  Json json = Json::object();
  if (!judged.parts.empty()) json["parts"] = judged.parts;
  if (judged.rate_hz > 0) json["rate_hz"] = judged.rate_hz;
  if (judged.compared_hz > 0) json["compared_hz"] = judged.compared_hz;
  for (const auto& [metric, share] : judged.shares) json["shares"][metric] = share;
  return json;
}

JudgedOn DecodeJudged(const Json& json) {
  JudgedOn judged{
      json.value("parts", std::vector<std::string>{}), json.value("rate_hz", 0.0), {}, json.value("compared_hz", 0.0)};
  const Json shares = json.value("shares", Json::object());
  for (const auto& [metric, share] : shares.items()) judged.shares.emplace_back(metric, share.get<double>());
  return judged;
}

Json EncodeRow(const Row& row) {
  Json json;
  json["cell"] = row.Id();
  json["scenario"] = row.scenario;
  json["task"] = row.task;
  json["condition"] = CompactLabel(row.condition);
  for (const SweptValue& swept : row.condition) {
    // A swept parameter with the name of a metric (wait_s) is left out, because the metric's value has that key.
    if (FindMetric(swept.key) == nullptr) json[swept.key] = ValueAsJson(swept.value);
  }
  json["trial"] = row.trial;
  json["clip"] = row.clip.empty() ? Json(nullptr) : Json(row.clip);
  if (!row.units.empty()) json["units"] = row.units;
  json["method"] = row.method;
  json["status"] = StatusName(row.result.status);
  json["reason"] = row.result.reason.empty() ? Json(nullptr) : Json(row.result.reason);
  Json null_reasons = Json::object();
  for (const MetricValue& metric : row.result.metrics) {
    json[metric.id] = metric.value ? Json(*metric.value) : Json(nullptr);
    if (!metric.value) null_reasons[metric.id] = metric.null_reason;
  }
  if (!null_reasons.empty()) json["null_reasons"] = std::move(null_reasons);
  if (const Json judged = EncodeJudged(row.result.judged); !judged.empty()) json["judged"] = judged;
  for (const auto& [stage, digest] : row.result.digests) json[std::string(kDigestPrefix) + stage] = digest;
  return json;
}

Result<Row> DecodeRow(const Json& json, const Place& place) {
  Row row;
  try {
    // Read the identity, status and reason.
    row.scenario = json.at("scenario").get<std::string>();
    row.task = json.at("task").get<std::string>();
    row.condition = SplitCondition(json.at("condition").get<std::string>());
    row.trial = json.at("trial").get<int>();
    row.clip = json.at("clip").is_null() ? "" : json.at("clip").get<std::string>();
    row.units = json.value("units", std::vector<std::string>{});
    row.method = json.at("method").get<std::string>();
    const auto status = FindStatus(json.at("status").get<std::string>());
    if (!status) return Fail(place, "unknown status {}", json.at("status").dump());
    row.result.status = *status;
    row.result.reason = json.at("reason").is_null() ? "" : json.at("reason").get<std::string>();
    row.result.judged = DecodeJudged(json.value("judged", Json::object()));
    // All other keys are digests, metrics or swept parameters.
    const Json null_reasons = json.value("null_reasons", Json::object());
    for (const auto& [key, value] : json.items()) {
      if (key.starts_with(kDigestPrefix)) {
        row.result.digests.emplace_back(key.substr(kDigestPrefix.size()), value.get<std::string>());
      } else if (FindMetric(key) != nullptr) {
        if (value.is_null()) {
          row.result.Missing(key, null_reasons.value(key, ""));
        } else {
          row.result.Measure(key, value.get<double>());
        }
      }
    }
  } catch (const Json::exception& error) {
    return Fail(place, "is not a row of cells.jsonl: {}", error.what());
  }
  return row;
}

Json EncodeSeries(const std::vector<Series>& series) {
  Json list = Json::array();
  for (const Series& curve : series) {
    list.push_back({{"name", curve.name}, {"axis", curve.axis}, {"values", curve.values}});
    if (!curve.names.empty()) list.back()["names"] = curve.names;
  }
  return list;
}

Json EncodeSeriesLine(const std::string& cell, const std::vector<Series>& series) {
  return {{"cell", cell}, {"series", EncodeSeries(series)}};
}

std::vector<Series> DecodeSeries(const Json& json) {
  std::vector<Series> series;
  for (const Json& curve : json) {
    series.push_back({curve.at("name").get<std::string>(), curve.at("axis").get<std::string>(),
                      curve.at("values").get<std::vector<double>>(), curve.value("names", std::vector<std::string>{})});
  }
  return series;
}

namespace {

Json JointNames() {
  Json names = Json::array();
  for (const Role role : AllRoles()) names.push_back(RoleName(role));
  return names;
}

Result<void> CheckRecordingHead(const Json& json, const Place& place) {
  if (!json.contains("recording") && json.contains("tracks")) {
    return Fail(place,
                "found a recording of version 1, which does not list its joints; this program reads version {}; repeat "
                "the run with 'etude run --from' and its manifest.json",
                kRecordingVersion);
  }
  if (const Json& version = json.at("recording"); version != kRecordingVersion) {
    return Fail(place, "found a recording of version {}; this program reads version {}", ShowJson(version),
                kRecordingVersion);
  }
  if (const Json& joints = json.at("joints"); joints != JointNames()) {
    return Fail(place, "'joints': found {}; allowed: the names of Etude's twenty joints, in the order of docs/clips.md",
                ShowJson(joints));
  }
  for (const auto& [key, allowed] : {std::pair{"unit", "m"}, {"up", "y"}}) {
    if (json.at(key) != allowed) return Fail(place, "'{}': {}; allowed: \"{}\"", key, ShowJson(json.at(key)), allowed);
  }
  return {};
}

}  // namespace

Result<Json> EncodeRecording(const Recording& recording) {
  ASSIGN_OR_RETURN(const auto motions, EncodeMotions(recording));
  Json json{{"recording", kRecordingVersion}, {"joints", JointNames()}, {"unit", "m"}, {"up", "y"}};
  json.update(motions);
  return json;
}

Result<Json> EncodeMotions(const Recording& recording) {
  Json json;
  Json& tracks = json["tracks"] = Json::array();
  for (const Track& track : recording.tracks) {
    Json poses = Json::array();
    for (const BodyPose& pose : track.motion.poses) poses.push_back(EncodePose(pose));
    tracks.push_back({{"name", track.name}, {"rate_hz", track.motion.rate_hz}, {"poses", std::move(poses)}});
  }
  auto extras = ReadJson(recording.extras_json.empty() ? "{}" : recording.extras_json, "a recording's extras");
  if (!extras) return extras;
  json["extras"] = std::move(*extras);
  return json;
}

Result<Recording> ReadRecording(const std::string& text, const std::string& file) {
  ASSIGN_OR_RETURN(const auto json, ReadJson(text, file));
  return DecodeRecording(json, {file});
}

Result<Recording> DecodeRecording(const Json& json, const Place& place) {
  Recording recording;
  try {
    RETURN_IF_ERROR(CheckRecordingHead(json, place));
    for (const Json& entry : json.at("tracks")) {
      Track track{entry.at("name").get<std::string>(), {entry.at("rate_hz").get<double>(), {}}};
      for (const Json& numbers : entry.at("poses")) {
        if (numbers.size() != 3 * kRoleCount) return Fail(place, "a pose has {} numbers, not 60", numbers.size());
        BodyPose& pose = track.motion.poses.emplace_back();
        for (std::size_t i = 0; i < numbers.size(); ++i) pose.joints[i / 3][i % 3] = numbers[i].get<double>();
      }
      recording.tracks.push_back(std::move(track));
    }
    recording.extras_json = json.at("extras").dump();
  } catch (const Json::exception& error) {
    return Fail(place, "not a recording: {}", error.what());
  }
  return recording;
}

Json EncodeUsage(const std::string& cell, const CellUsage& usage) {
  Json json{{"cell", cell}, {"wall_s", usage.wall_s}, {"cpu_s", usage.cpu_s}, {"peak_mb", usage.peak_mb}};
  if (usage.world_wall_s > 0) {
    json["world_wall_s"] = usage.world_wall_s;
    json["world_cpu_s"] = usage.world_cpu_s;
  }
  return json;
}

}  // namespace etude
