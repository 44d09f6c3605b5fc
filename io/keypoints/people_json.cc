#include "io/keypoints/people_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/base/text.h"
#include "io/keypoints/frame_numbers.h"

namespace etude {
namespace {

constexpr double kHalfPixel = 0.5;
constexpr double kMaxListedPixel = 1e6;

/// Returns true if the names differ only in their numbers.
bool AreOnlyNumbered(std::vector<std::string> names) {
  for (std::string& name : names) std::erase_if(name, IsDigit);
  return std::ranges::all_of(names, [&](const std::string& name) { return name == names.front(); });
}

/// Returns the landmark of a foot where no ankle is named: Human3.6M calls the ankle a foot.
Landmark AnkleOfFoot(const std::string& name) {
  for (const char* foot : {"foot", "Foot", "FOOT"}) {
    const std::size_t at = name.find(foot);
    if (at != std::string::npos) return LandmarkOfName(std::string(name).replace(at, 4, "ankle"));
  }
  return Landmark::kNoLandmark;
}

/// Finds the landmark of each name. A landmark that matches several names gets none of them, because such names are
/// points of a hand or a face. `head` is not the top of the head if that has a name of its own, as in MPI-INF-3DHP.
std::vector<Landmark> LandmarksOf(const std::vector<std::string>& names) {
  std::vector<Landmark> landmarks;
  for (const std::string& name : names) landmarks.push_back(LandmarkOfName(name));
  const auto count = [&](Landmark landmark) { return std::ranges::count(landmarks, landmark); };
  const std::vector<Landmark> first = landmarks;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_twice = std::ranges::count(first, first[i]) > 1;
    const bool is_top = first[i] == Landmark::kHead && names[i].size() > LandmarkName(Landmark::kHead).size();
    if (is_twice && !is_top) landmarks[i] = Landmark::kNoLandmark;
  }
  if (count(Landmark::kLeftAnkle) + count(Landmark::kRightAnkle) > 0) return landmarks;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (landmarks[i] == Landmark::kNoLandmark) landmarks[i] = AnkleOfFoot(names[i]);
  }
  return landmarks;
}

}  // namespace

const Json* Member(const Json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  return json.is_object() && found != json.end() ? &*found : nullptr;
}

const Json* FirstMember(const Json& json, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const Json* member = Member(json, name)) return member;
  }
  return nullptr;
}

std::string TextOf(const Json* json) { return json != nullptr && json->is_string() ? json->get<std::string>() : ""; }

std::optional<double> NumberOf(const Json* json) {
  return json != nullptr && json->is_number() ? std::optional(json->get<double>()) : std::nullopt;
}

std::vector<std::string> TextsOf(const Json* list) {
  std::vector<std::string> texts;
  if (list == nullptr || !list->is_array()) return texts;
  for (const Json& text : *list) texts.push_back(TextOf(&text));
  return texts;
}

KeypointNames::KeypointNames(std::vector<std::string> stated) {
  if (stated.empty() || AreOnlyNumbered(stated)) return;
  names = std::move(stated);
  landmarks = LandmarksOf(names);
  known = names.size() - static_cast<std::size_t>(std::ranges::count(landmarks, Landmark::kNoLandmark));
}

KeypointNames NamesOfMeta(const Json& json) {
  const Json* meta = Member(json, "meta_info");
  const Json* names = meta == nullptr ? nullptr : Member(*meta, "keypoint_id2name");
  if (names != nullptr && names->is_array()) return KeypointNames(TextsOf(names));
  const Json* ids = meta == nullptr ? nullptr : Member(*meta, "keypoint_name2id");
  // Order the names by the keypoints' numbers.
  std::map<long, std::string> ordered;
  if (names != nullptr && names->is_object()) {
    for (const auto& [id, name] : names->items()) {
      const auto number = FrameNumber(Json(id));
      if (number && name.is_string()) ordered[*number] = name.get<std::string>();
    }
  } else if (ids != nullptr && ids->is_object()) {
    for (const auto& [name, id] : ids->items()) {
      if (id.is_number_integer()) ordered[id.get<long>()] = name;
    }
  }
  std::vector<std::string> list;
  for (const auto& [id, name] : ordered) list.push_back(name);
  return KeypointNames(std::move(list));
}

Result<std::vector<Keypoint>> Triples(const Json* list, const Place& place) {
  if (list == nullptr || !list->is_array() || list->size() % 3 != 0) {
    return Fail(place, "this is not a list of keypoints{}; allowed: a list with x, y and confidence for each keypoint",
                list == nullptr || !list->is_array() ? "" : fmt::format(" ({} numbers)", list->size()));
  }
  std::vector<Keypoint> points;
  for (std::size_t i = 0; i < list->size(); i += 3) {
    double v[3];
    if ((*list)[i].is_null() || (*list)[i + 1].is_null() || (*list)[i + 2].is_null()) {
      points.emplace_back();
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Json& number = (*list)[i + k];
      v[k] = number.is_number() ? number.get<double>() : std::nan("");
      if (!(std::abs(v[k]) <= kMaxListedPixel)) {
        return Fail(place, "a number of a keypoint is {}; allowed: at most {:g}", number.dump(), kMaxListedPixel);
      }
    }
    points.push_back({glm::dvec2(v[0], v[1]) + kHalfPixel, v[2]});
  }
  return points;
}

namespace {

Result<const KeypointLayout*> LayoutOf(std::size_t count, const std::string& named, const Place& place) {
  std::vector<const KeypointLayout*> fitting;
  std::string counts;
  for (const KeypointLayout& layout : KeypointLayouts()) {
    if (layout.landmarks.size() + layout.more == count && (named.empty() ? !layout.is_rare : named == layout.name))
      fitting.push_back(&layout);
    counts += (counts.empty() ? "" : ", ") + fmt::format("{} ({})", layout.name, layout.landmarks.size() + layout.more);
  }
  if (fitting.size() == 1) return fitting.front();
  if (fitting.empty()) {
    return Fail(place, "found {} keypoints per person{}; allowed: {}", count,
                named.empty() ? "" : ", which do not fit the layout " + named, counts);
  }
  return Fail(place, "{} keypoints per person may have the layout {} or {}; use --layout to choose one of them", count,
              fitting[0]->name, fitting[1]->name);
}

/// Returns the first names of a file, for a message.
std::string SomeOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxShown = 20;
  const std::span<const std::string> shown(names.data(), std::min(names.size(), kMaxShown));
  return fmt::format("{}{}", fmt::join(shown, ", "), shown.size() < names.size() ? ", …" : "");
}

std::string AllLandmarks() {
  std::string text;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    text += (i == 0 ? "" : ", ") + std::string(LandmarkName(static_cast<Landmark>(i)));
  }
  return text;
}

/// Returns the landmark of each keypoint; further keypoints have none.
Result<std::span<const Landmark>> OrderOf(std::size_t count, const std::string& layout, const KeypointNames& names,
                                          const Place& place) {
  const bool is_named = !names.names.empty();
  if (layout.empty() && is_named && names.names.size() == count) {
    constexpr std::size_t kMinKnown = 12;
    if (names.known >= kMinKnown) return std::span(names.landmarks);
    return Fail(place,
                "Etude knows only {} of the {} keypoint names ({}); allowed: at least {} names of {}, or --layout",
                names.known, count, SomeOf(names.names), kMinKnown, AllLandmarks());
  }
  const auto found = LayoutOf(count, layout, place);
  if (!found && layout.empty() && is_named) {
    return Fail(place, "found {} keypoints per person, but {} names ({}); allowed: a name for each keypoint", count,
                names.names.size(), SomeOf(names.names));
  }
  ASSIGN_OR_RETURN(const KeypointLayout* chosen, found);
  // Names that the file states must not contradict the layout.
  for (std::size_t i = 0; i < std::min(names.landmarks.size(), chosen->landmarks.size()); ++i) {
    const Landmark stated = names.landmarks[i], taken = chosen->landmarks[i];
    if (stated == taken || stated == Landmark::kNoLandmark || taken == Landmark::kNoLandmark) continue;
    return Fail(place,
                "keypoint {} has the name {} in the file, but is {} in the layout {} ({} names, {} keypoints); {}",
                i + 1, names.names[i], LandmarkName(taken), chosen->name, names.names.size(), count,
                layout.empty() ? "allowed: a name for each keypoint" : "leave out --layout, or remove the names");
  }
  return std::span(chosen->landmarks);
}

/// Reads a coordinate or a confidence, which may be a flag; a missing value or null gives nullopt.
Result<std::optional<double>> ValueOf(const Json* json, const Place& place) {
  if (json == nullptr || json->is_null()) return std::optional<double>();
  if (json->is_boolean()) return std::optional(json->get<bool>() ? 1.0 : 0.0);
  const auto value = NumberOf(json);
  if (value && std::abs(*value) <= kMaxListedPixel) return value;
  return Fail(place, "a value of a keypoint is {}; allowed: null, or a number of at most {:g}", ShowJson(*json),
              kMaxListedPixel);
}

/// Makes a point of its coordinates and its confidence; a point without coordinates was not seen. `sure` is null if
/// points have no confidence.
Result<Keypoint> PointAt(const Json* x, const Json* y, const Json* sure, const Place& place) {
  ASSIGN_OR_RETURN(const auto column, ValueOf(x, place));
  ASSIGN_OR_RETURN(const auto row, ValueOf(y, place));
  ASSIGN_OR_RETURN(const auto confidence, ValueOf(sure, place));
  if (!column || !row) return Keypoint{};
  return Keypoint{glm::dvec2(*column, *row) + kHalfPixel, sure == nullptr ? 1 : confidence.value_or(0)};
}

/// Reads a point with named coordinates. Fails if an additional number may be a score under an unknown name.
Result<Keypoint> PointOf(const Json& json, const Place& place) {
  const Json* sure = FirstMember(json, {"visibility", "score", "confidence", "conf", "likelihood", "probability",
                                        "prob", "keypoint_score", "kp_score", "c", "p", "v", "visible"});
  for (const auto& [key, value] : json.items()) {
    constexpr std::array kNoScores = {"x", "y", "z", "id", "index", "presence", "world_x", "world_y", "world_z"};
    if (sure != nullptr || !value.is_number_float() || std::ranges::count(kNoScores, key) > 0) continue;
    return Fail(place,
                "a keypoint has the number '{}' in addition to x and y; allowed: score, confidence or visibility", key);
  }
  return PointAt(Member(json, "x"), Member(json, "y"), sure, place);
}

/// Returns the list of a person's scores; null if there is none. Fails if another list of numbers, as long as the list
/// of keypoints, may be the scores.
Result<const Json*> ScoresOf(const Json& person, std::size_t keypoints, const Place& place) {
  if (const Json* scores =
          FirstMember(person, {"keypoint_scores", "scores", "keypoints_scores", "kpt_scores", "kp_scores", "kp_score",
                               "keypoints_visible", "confidences", "conf", "confidence", "likelihood"})) {
    return scores;
  }
  const auto is_number = [](const Json& entry) { return entry.is_number_float(); };
  if (!person.is_object()) return nullptr;
  for (const auto& [key, value] : person.items()) {
    if (!value.is_array() || value.size() != keypoints || !std::ranges::all_of(value, is_number)) continue;
    return Fail(place, "a person has the list '{}' in addition to the keypoints; allowed: keypoint_scores", key);
  }
  return nullptr;
}

/// Reads points [[x, y], …] with a list of scores, or [x, y, score].
Result<std::vector<Keypoint>> PointsOfPairs(const Json& list, const Json* scores, const Place& place) {
  std::vector<Keypoint> points;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& pair = list[i];
    if (!pair.is_array() || pair.size() < 2) return Fail(place, "a keypoint is {}; allowed: [x, y]", ShowJson(pair));
    const Json* sure = pair.size() > 2 ? &pair[2] : nullptr;
    if (scores != nullptr && scores->is_array() && scores->size() == list.size()) {
      if (pair.size() > 2 && pair[2] != (*scores)[i]) {
        return Fail(place,
                    "a keypoint has {} coordinates in addition to a score: {}; allowed: pixels of one picture, [x, y]",
                    pair.size(), ShowJson(pair));
      }
      sure = &(*scores)[i];
    }
    ASSIGN_OR_RETURN(const Keypoint read, PointAt(&pair[0], &pair[1], sure, place));
    points.push_back(read);
  }
  return points;
}

/// Returns true for keypoints as one list for each coordinate, {"x": [...], "y": [...]}, as Ultralytics writes them.
bool HasCoordinateLists(const Json& json) {
  const Json *x = Member(json, "x"), *y = Member(json, "y");
  return x != nullptr && y != nullptr && x->is_array() && y->is_array();
}

/// Reads the points of HasCoordinateLists, with a list of scores or null; other values than lists do not count.
Result<std::vector<Keypoint>> PointsOfCoordinates(const Json& lists, const Json* scores, const Place& place) {
  std::vector<Keypoint> points;
  const std::size_t count = Member(lists, "x")->size();
  for (const auto& [key, list] : lists.items()) {
    if (list.is_array() && list.size() != count) {
      return Fail(place, "the keypoints have {} values of x, but '{}' is a list of {}; allowed: lists of equal length",
                  count, key, list.size());
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    Json point = Json::object();
    for (const auto& [key, list] : lists.items()) {
      if (list.is_array()) point[key] = list[i];
    }
    if (scores != nullptr && scores->is_array() && scores->size() == count) point["score"] = (*scores)[i];
    ASSIGN_OR_RETURN(const Keypoint read, PointOf(point, place));
    points.push_back(read);
  }
  return points;
}

bool IsPoints(const Json& list) {
  if (HasCoordinateLists(list)) return true;
  if (!list.is_array() || list.empty()) return false;
  const Json& first = list.front();
  const auto is_flat = [](const Json& entry) { return entry.is_number() || entry.is_null(); };
  return (first.is_object() && Member(first, "x") != nullptr) ||
         (first.is_array() && !first.empty() && first[0].is_number()) || std::ranges::all_of(list, is_flat);
}

const Json* KeypointsOf(const Json& person) {
  return FirstMember(person, {"keypoints", "pose_keypoints_2d", "pose_keypoints", "pose_landmarks", "landmarks"});
}

Result<SeenPerson> PersonOfList(const Json& json, const std::string& layout, const KeypointNames& names,
                                const Place& place) {
  ASSIGN_OR_RETURN(const ListedPerson listed, PointsOf(json, place));
  return ToPerson(listed.points, layout, listed.names.names.empty() ? names : listed.names, place);
}

}  // namespace

Result<SeenPerson> ToPerson(const std::vector<Keypoint>& points, const std::string& layout, const KeypointNames& names,
                            const Place& place) {
  ASSIGN_OR_RETURN(const auto order, OrderOf(points.size(), layout, names, place));
  SeenPerson person;
  for (std::size_t i = 0; i < order.size(); ++i) {
    // Programs write (0, 0) or (−1, −1) for points that they did not find, even with a score.
    const glm::dvec2 listed = points[i].pixel - kHalfPixel;
    const bool is_seen = points[i].confidence > 0 && listed != glm::dvec2(0) && listed != glm::dvec2(-1);
    if (order[i] != Landmark::kNoLandmark && is_seen) {
      person[order[i]] = points[i];
    }
  }
  return person;
}

bool HasKeypoints(const Json& person) {
  const Json* list = KeypointsOf(person);
  return list != nullptr && !list->is_null() && !(list->is_array() && list->empty());
}

Result<ListedPerson> PointsOf(const Json& person, const Place& place) {
  const Json* list = person.is_array() || HasCoordinateLists(person) ? &person : KeypointsOf(person);
  ListedPerson listed;
  if (list != nullptr && HasCoordinateLists(*list)) {
    const Json* scores = nullptr;
    if (list != &person) {
      ASSIGN_OR_RETURN(scores, ScoresOf(person, Member(*list, "x")->size(), place));
    }
    ASSIGN_OR_RETURN(listed.points, PointsOfCoordinates(*list, scores, place));
    return listed;
  }
  if (list == nullptr || !list->is_array() || list->empty()) {
    return Fail(place, "found a person without a list of keypoints: {}", ShowJson(person));
  }
  if (list->front().is_array()) {
    ASSIGN_OR_RETURN(const Json* scores, ScoresOf(person, list->size(), place));
    ASSIGN_OR_RETURN(listed.points, PointsOfPairs(*list, scores, place));
  } else if (!list->front().is_object()) {
    ASSIGN_OR_RETURN(listed.points, Triples(list, place));
  } else {
    std::vector<std::string> names;
    for (const Json& point : *list) {
      ASSIGN_OR_RETURN(const Keypoint read, PointOf(point, place));
      listed.points.push_back(read);
      names.push_back(TextOf(Member(point, "name")));
    }
    listed.names = KeypointNames(std::move(names));
  }
  return listed;
}

Result<std::vector<SeenPerson>> PeopleOfList(const Json& list, const std::string& layout, const KeypointNames& names,
                                             const Place& place) {
  std::vector<SeenPerson> people;
  if (list.is_null()) return people;
  if (IsPoints(list)) {
    ASSIGN_OR_RETURN(const SeenPerson person, PersonOfList(list, layout, names, place));
    people.push_back(person);
    return people;
  }
  if (!list.is_array()) return Fail(place, "people are {}; allowed: a list", ShowJson(list));
  if (list.size() > kMaxPeople) return Fail(place, "{} people; allowed: {}", list.size(), kMaxPeople);
  for (const Json& one : list) {
    ASSIGN_OR_RETURN(const SeenPerson person, PersonOfList(one, layout, names, place));
    people.push_back(person);
  }
  return people;
}

}  // namespace etude
