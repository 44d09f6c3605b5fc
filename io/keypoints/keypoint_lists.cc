#include "io/keypoints/keypoint_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/base/order_statistics.h"
#include "engine/formats/row_clock.h"

namespace etude {
namespace {

constexpr double kHalfPixel = 0.5;
constexpr double kMaxListedPixel = 1e6;

}  // namespace

const Json* Member(const Json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  return json.is_object() && found != json.end() ? &*found : nullptr;
}

namespace {

Result<const KeypointLayout*> LayoutOf(std::size_t count, const std::string& named, const Place& place) {
  std::vector<const KeypointLayout*> fitting;
  std::string counts;
  for (const KeypointLayout& layout : KeypointLayouts()) {
    if (layout.landmarks.size() + layout.more == count && (named.empty() || named == layout.name))
      fitting.push_back(&layout);
    counts += (counts.empty() ? "" : ", ") + fmt::format("{} ({})", layout.name, layout.landmarks.size() + layout.more);
  }
  if (fitting.size() == 1) return fitting.front();
  if (fitting.empty()) {
    return Fail(place, "{} keypoints a person{}; allowed: {}", count, named.empty() ? "" : ", not " + named, counts);
  }
  return Fail(place, "{} keypoints per person may be the layout {} or {}; choose one by --layout", count,
              fitting[0]->name, fitting[1]->name);
}

}  // namespace

std::vector<std::string> TextsOf(const Json* list) {
  std::vector<std::string> texts;
  if (list == nullptr || !list->is_array()) return texts;
  for (const Json& text : *list) texts.push_back(text.is_string() ? text.get<std::string>() : "");
  return texts;
}

Result<std::vector<Keypoint>> Triples(const Json* list, const Place& place) {
  if (list == nullptr || !list->is_array() || list->size() % 3 != 0) {
    return Fail(place, "not a list of keypoints; allowed: a list of x, y and confidence for each keypoint");
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
        return Fail(place, "a keypoint's number is {}; allowed: at most {:g}", number.dump(), kMaxListedPixel);
      }
    }
    points.push_back({glm::dvec2(v[0], v[1]) + kHalfPixel, v[2]});
  }
  return points;
}

Result<SeenPerson> ToPerson(const std::vector<Keypoint>& points, const std::string& layout,
                            const std::vector<std::string>& names, const Place& place) {
  std::vector<Landmark> order;
  const auto found = LayoutOf(points.size(), layout, place);
  if (found) {
    order = (*found)->landmarks;
  } else {
    // If no layout, or more than one, has this number of keypoints, use the keypoints' names, provided that enough
    // names are known.
    std::size_t known = 0;
    for (const std::string& name : names) {
      order.push_back(LandmarkOfName(name));
      if (order.back() != Landmark::kNoLandmark) ++known;
    }
    constexpr std::size_t kMinKnown = 12;
    if (!layout.empty() || names.size() != points.size() || known < kMinKnown) return tl::unexpected(found.error());
  }
  SeenPerson person;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] != Landmark::kNoLandmark && points[i].confidence > 0) {
      person[order[i]] = {points[i].pixel, std::min(points[i].confidence, 1.0)};
    }
  }
  return person;
}

namespace {

std::optional<double> NumberOf(const Json* json) {
  if (json == nullptr || !json->is_number()) return std::nullopt;
  const double value = json->get<double>();
  return std::abs(value) <= kMaxListedPixel ? std::optional(value) : std::nullopt;
}

const Json* FirstMember(const Json& json, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const Json* member = Member(json, name)) return member;
  }
  return nullptr;
}

/// Reads a point with named coordinates; a point without numbers was not seen.
Keypoint PointOf(const Json& json) {
  const auto x = NumberOf(Member(json, "x")), y = NumberOf(Member(json, "y"));
  const Json* sure = FirstMember(json, {"visibility", "score", "confidence"});
  if (!x || !y) return {};
  return {glm::dvec2(*x, *y) + kHalfPixel, sure == nullptr ? 1 : NumberOf(sure).value_or(0)};
}

/// Reads points [[x, y], …] with a list of scores, or [x, y, score].
Result<std::vector<Keypoint>> PointsOfPairs(const Json& list, const Json* scores, const Place& place) {
  std::vector<Keypoint> points;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& pair = list[i];
    if (!pair.is_array() || pair.size() < 2) return Fail(place, "a keypoint is {}; allowed: [x, y]", ShowJson(pair));
    const auto x = NumberOf(&pair[0]), y = NumberOf(&pair[1]);
    double sure = 1;
    if (scores != nullptr && scores->is_array() && scores->size() == list.size()) {
      sure = NumberOf(&(*scores)[i]).value_or(0);
    } else if (pair.size() > 2) {
      sure = NumberOf(&pair[2]).value_or(0);
    }
    points.push_back(x && y ? Keypoint{glm::dvec2(*x, *y) + kHalfPixel, sure} : Keypoint{});
  }
  return points;
}

Result<std::vector<Keypoint>> PointsOf(const Json& person, const Place& place) {
  const Json* list =
      person.is_array()
          ? &person
          : FirstMember(person, {"keypoints", "pose_keypoints_2d", "pose_keypoints", "pose_landmarks", "landmarks"});
  if (list == nullptr || !list->is_array() || list->empty()) {
    return Fail(place, "a person without a list of keypoints: {}", ShowJson(person));
  }
  if (list->front().is_array()) return PointsOfPairs(*list, FirstMember(person, {"keypoint_scores", "scores"}), place);
  if (!list->front().is_object()) return Triples(list, place);
  std::vector<Keypoint> points;
  for (const Json& point : *list) points.push_back(PointOf(point));
  return points;
}

bool IsPoints(const Json& list) {
  if (!list.is_array() || list.empty()) return false;
  const Json& first = list.front();
  return (first.is_object() && Member(first, "x") != nullptr) ||
         (first.is_array() && !first.empty() && first[0].is_number());
}

}  // namespace

Result<std::vector<SeenPerson>> PeopleOfList(const Json& list, const std::string& layout,
                                             const std::vector<std::string>& names, const Place& place) {
  std::vector<SeenPerson> people;
  if (list.is_null()) return people;
  if (IsPoints(list)) {
    ASSIGN_OR_RETURN(const auto points, PointsOf(list, place));
    ASSIGN_OR_RETURN(const SeenPerson person, ToPerson(points, layout, names, place));
    people.push_back(person);
    return people;
  }
  if (!list.is_array()) return Fail(place, "people are {}; allowed: a list", ShowJson(list));
  if (list.size() > kMaxPeople) return Fail(place, "{} people; allowed: {}", list.size(), kMaxPeople);
  for (const Json& one : list) {
    ASSIGN_OR_RETURN(const auto points, PointsOf(one, place));
    ASSIGN_OR_RETURN(const SeenPerson person, ToPerson(points, layout, names, place));
    people.push_back(person);
  }
  return people;
}

bool IsKeypointList(const Json& json) {
  if (json.is_array()) return !json.empty();
  const Json* list = FirstMember(json, {"instance_info", "frames"});
  return list != nullptr && list->is_array();
}

namespace {

/// Returns the number of a frame: `id` itself, or the last number in a file's name.
std::optional<long> FrameNumber(const Json& id) {
  if (id.is_number_integer()) return id.get<long>();
  if (!id.is_string()) return std::nullopt;
  std::string text = id.get<std::string>();
  if (const std::size_t dot = text.find_last_of('.'); dot != std::string::npos && dot > 0) text.resize(dot);
  const std::size_t end = text.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  const std::size_t before = text.find_last_not_of("0123456789", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  long number = 0;
  const auto [at, error] = std::from_chars(text.data() + begin, text.data() + end + 1, number);
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

constexpr long kMaxFrames = 1'000'000;

/// Puts numbered frames in order and returns them as a film.
Result<PeopleOfFilm> Ordered(std::map<long, std::vector<SeenPerson>> numbered, const FilmOfKeypoints& of,
                             const Place& place) {
  PeopleOfFilm film;
  if (numbered.empty()) return Fail(place, "no frame");
  const long lowest = numbered.begin()->first, highest = numbered.rbegin()->first;
  if (lowest < 0 || highest > kMaxFrames)
    return Fail(place, "frames {} to {}; allowed: 0 to {}", lowest, highest, kMaxFrames);
  const auto frames = static_cast<long>(of.frames);
  // If the film's length is not known, the frame numbers give it.
  const long first = frames > 0 ? (lowest > 0 && highest == frames ? 1 : 0) : std::min(lowest, 1L);
  const long count = frames > 0 ? std::max(frames, highest - first + 1) : highest - first + 1;
  film.frames.resize(static_cast<std::size_t>(count));
  for (auto& [number, people] : numbered) film.frames[static_cast<std::size_t>(number - first)] = std::move(people);
  if (frames > 0 && lowest > 0 && highest < frames) {
    film.told =
        fmt::format("frames are numbered {} to {}, and the film has {}; the numbers are assumed to be counted from 0",
                    lowest, highest, frames);
  }
  return film;
}

/// Moves the i-th frame to `indices[i]`; indices ascend. `count` is the number of frames afterwards. Adds a note if
/// frames are missing.
void MoveFrames(std::span<const std::size_t> indices, std::size_t count, PeopleOfFilm& film) {
  SeenPeople frames(count);
  for (std::size_t i = 0; i < indices.size(); ++i) frames[indices[i]] = std::move(film.frames[i]);
  // Count the frames within the recording that have no entry.
  const std::size_t missing = indices.back() - indices.front() + 1 - indices.size();
  if (missing > 0) {
    film.told += film.told.empty() ? "" : "; ";
    film.told += fmt::format(
        "{} of {} frames are missing, as the numbers or times of the others show; they are taken to show nobody",
        missing, count);
  }
  film.frames = std::move(frames);
}

constexpr std::size_t kMaxSpread = 10;  // maximum number of frames per entry of a list

/// Returns the time of a frame, in the unit that the file uses.
std::optional<double> TimeOf(const Json& frame) {
  constexpr const char* kNames[] = {"timestamp", "timestamp_ms", "timestamp_us", "timestamp_ns", "timestamp_s",
                                    "time",      "time_s",       "time_ms",      "timestampMs",  "t"};
  for (const char* name : kNames) {
    const Json* time = Member(frame, name);
    if (time != nullptr && time->is_number() && std::isfinite(time->get<double>())) return time->get<double>();
  }
  return std::nullopt;
}

/// Moves the frames of a film to the positions that their times state, in any unit. Does nothing if the times do not
/// ascend or are too uneven.
void LayByTimes(const std::vector<double>& times, PeopleOfFilm& film) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    steps.push_back(times[i] - times[i - 1]);
    if (!(steps.back() > 0)) return;
  }
  if (steps.empty()) return;
  // Scale the times so that the median step between frames is 1/30 s.
  const double usual = UpperMedian(std::move(steps)) * kJudgedRateHz;
  std::vector<double> scaled;
  for (const double time : times) scaled.push_back((time - times.front()) / usual);
  const auto grid = GridOfRows(scaled, {}, std::nullopt, 1, "");
  if (!grid || !*grid || (*grid)->frames.size() > kMaxSpread * times.size()) return;
  std::vector<std::size_t> indices;
  for (const double time : scaled) {
    const double index = std::round(time * (*grid)->rate_hz);
    // The times are too uneven if two frames would get the same index.
    if (!indices.empty() && static_cast<std::size_t>(index) <= indices.back()) return;
    indices.push_back(static_cast<std::size_t>(index));
  }
  MoveFrames(indices, indices.back() + 1, film);
}

/// Returns the names in MMPose's `keypoint_id2name`, in the order of the keypoints' numbers.
std::vector<std::string> MetaNames(const Json& json) {
  const Json* meta = Member(json, "meta_info");
  const Json* names = meta == nullptr ? nullptr : Member(*meta, "keypoint_id2name");
  std::map<long, std::string> ordered;
  if (names != nullptr && names->is_object()) {
    for (const auto& [id, name] : names->items()) {
      const auto number = FrameNumber(Json(id));
      if (number && name.is_string()) ordered[*number] = name.get<std::string>();
    }
  }
  std::vector<std::string> list;
  for (const auto& [id, name] : ordered) list.push_back(name);
  return list;
}

/// Reads results: one object per person, whose image_id gives the frame. If the largest confidence exceeds 1, as COCO's
/// flags and AlphaPose's scores may, all confidences are divided by it.
Result<PeopleOfFilm> ReadResults(const Json& list, const std::string& layout, const FilmOfKeypoints& of,
                                 const Place& place) {
  // Collect the points of every frame and the largest confidence.
  std::map<long, std::vector<std::vector<Keypoint>>> numbered;
  double max_confidence = 1;
  for (const Json& one : list) {
    const Json* id = Member(one, "image_id");
    const auto number = id == nullptr ? std::nullopt : FrameNumber(*id);
    if (!number) return Fail(place, "a result whose image_id has no number: {}", ShowJson(one));
    ASSIGN_OR_RETURN(auto points, PointsOf(one, place));
    for (const Keypoint& point : points) max_confidence = std::max(max_confidence, point.confidence);
    if (numbered[*number].size() >= kMaxPeople) return Fail(place, "more than {} people in a frame", kMaxPeople);
    numbered[*number].push_back(std::move(points));
  }
  // Scale the confidences to 0…1 and order the landmarks.
  std::map<long, std::vector<SeenPerson>> people;
  for (auto& [number, persons] : numbered) {
    for (std::vector<Keypoint>& points : persons) {
      for (Keypoint& point : points) point.confidence /= max_confidence;
      ASSIGN_OR_RETURN(const SeenPerson person, ToPerson(points, layout, {}, place));
      people[number].push_back(person);
    }
  }
  return Ordered(std::move(people), of, place);
}

}  // namespace

Result<PeopleOfFilm> ReadKeypointList(const Json& json, const std::string& layout, const FilmOfKeypoints& of,
                                      const Place& place) {
  const Json& list = json.is_array() ? json : *FirstMember(json, {"instance_info", "frames"});
  if (list.empty()) return Fail(place, "an empty list of frames");
  if (Member(list.front(), "image_id") != nullptr) return ReadResults(list, layout, of, place);
  const std::vector<std::string> names = MetaNames(json);
  std::map<long, std::vector<SeenPerson>> numbered;
  std::vector<double> times;
  // Read the number and the people of every frame.
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& frame = list[i];
    const Json* id = FirstMember(frame, {"frame_id", "frame", "frame_index"});
    if (const auto time = id == nullptr ? TimeOf(frame) : std::nullopt) times.push_back(*time);
    const auto number = id != nullptr ? FrameNumber(*id) : std::optional(static_cast<long>(i));
    if (!number) return Fail(place, "frame {} is not a number", ShowJson(*id));
    const Json* people = frame.is_object()
                             ? FirstMember(frame, {"instances", "people", "pose_landmarks", "landmarks", "keypoints"})
                             : &frame;
    if (people == nullptr) {
      return Fail(place, "frame {} has none of the keys instances, people, pose_landmarks, landmarks and keypoints", i);
    }
    ASSIGN_OR_RETURN(numbered[*number], PeopleOfList(*people, layout, names, place));
  }
  ASSIGN_OR_RETURN(auto film, Ordered(std::move(numbered), of, place));
  if (times.size() == list.size() && of.frames != list.size() && film.frames.size() == list.size()) {
    LayByTimes(times, film);
  }
  return film;
}

void LayByNames(std::span<const std::string> names, const FilmOfKeypoints& of, PeopleOfFilm& film) {
  if (names.size() < 2 || names.size() != film.frames.size() || of.frames == names.size()) return;
  // Read the number at the end of each name. The text before the number must be the same in all names, and the numbers
  // must ascend.
  const auto text_of = [](std::string name) {
    if (const std::size_t dot = name.find_last_of('.'); dot != std::string::npos && dot > 0) name.resize(dot);
    const std::size_t end = name.find_last_of("0123456789");
    const std::size_t before = end == std::string::npos ? end : name.find_last_not_of("0123456789", end);
    return name.substr(0, before == std::string::npos ? 0 : before + 1);
  };
  std::vector<long> numbers;
  std::vector<double> steps;
  for (const std::string& name : names) {
    const auto number = FrameNumber(Json(name));
    if (!number || text_of(name) != text_of(names.front()) || (!numbers.empty() && *number <= numbers.back())) return;
    if (!numbers.empty()) steps.push_back(static_cast<double>(*number - numbers.back()));
    numbers.push_back(*number);
  }
  // Numbers may increase by more than 1 per frame, and may count from 0, from 1 or from any first number.
  const auto usual = static_cast<long>(LowerPercentile(std::move(steps), 0.5));
  const auto frames = static_cast<long>(of.frames);
  const long last = numbers.back();
  long first = numbers.front();
  if (usual == 1 && first > 1 && last <= frames) first = last == frames ? 1 : 0;
  std::vector<std::size_t> indices;
  for (const long number : numbers) {
    if ((number - first) % usual != 0) return;
    indices.push_back(static_cast<std::size_t>((number - first) / usual));
  }
  if (indices.back() + 1 == names.size()) return;  // no frame is missing before the last one
  const std::size_t count = std::max(of.frames, indices.back() + 1);
  if (indices.back() >= kMaxSpread * indices.size() + of.frames) return;
  MoveFrames(indices, count, film);
}

}  // namespace etude
