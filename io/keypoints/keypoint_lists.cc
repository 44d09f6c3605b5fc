#include "io/keypoints/keypoint_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "io/keypoints/frame_numbers.h"
#include "io/keypoints/layout_doubts.h"
#include "io/keypoints/people_json.h"

namespace etude {

namespace {

/// Returns the people of an image in AlphaPose's formats `open` and `cmu`, {"people": [{"pose_keypoints_2d": […]}]} and
/// {"bodies": [{"joints": […]}]}; null for other JSON.
const Json* PeopleOfImage(const Json& image) {
  const Json* people = FirstMember(image, {"people", "bodies"});
  return people != nullptr && people->is_array() ? people : nullptr;
}

/// Returns true for AlphaPose's formats `open` and `cmu`: an object whose keys are the names of the images.
bool IsOfImages(const Json& json) {
  return json.is_object() && !json.empty() && std::ranges::all_of(json, PeopleOfImage);
}

/// Converts AlphaPose's formats `open` and `cmu` to its usual list of results.
Json ResultsOfImages(const Json& images) {
  Json results = Json::array();
  for (const auto& [name, image] : images.items()) {
    for (const Json& person : *PeopleOfImage(image)) {
      const Json* list = FirstMember(person, {"pose_keypoints_2d", "joints"});
      results.push_back({{"image_id", name}, {"keypoints", list == nullptr ? Json() : *list}});
    }
  }
  return results;
}

}  // namespace

bool IsKeypointList(const Json& json) {
  if (json.is_array()) return !json.empty();
  if (IsOfImages(json)) return true;
  const Json* list = FirstMember(json, {"instance_info", "frames"});
  return list != nullptr && list->is_array();
}

namespace {

/// Returns the time of a frame, in the unit that the file uses.
std::optional<double> TimeOf(const Json& frame) {
  constexpr const char* kNames[] = {"timestamp", "timestamp_ms", "timestamp_us", "timestamp_ns", "timestamp_s",
                                    "time",      "time_s",       "time_ms",      "timestampMs",  "t"};
  for (const char* name : kNames) {
    if (const auto time = NumberOf(Member(frame, name)); time && std::isfinite(*time)) return time;
  }
  return std::nullopt;
}

/// Reads results: one object per person, whose image_id gives the frame. COCO's flags and AlphaPose's scores go up
/// to 2, and are scaled to 0…1.
Result<PeopleOfFilm> ReadResults(const Json& list, const std::string& layout, const FilmOfKeypoints& of,
                                 const Place& place) {
  // Collect the points of every frame and the confidences.
  std::map<long, std::vector<ListedPerson>> numbered;
  double largest = 0;
  std::size_t boxes = 0;
  for (const Json& one : list) {
    const Json* id = Member(one, "image_id");
    const auto number = id == nullptr ? std::nullopt : FrameNumber(*id);
    if (!number) return Fail(place, "the image_id of a result contains no number: {}", ShowJson(one));
    if (!HasKeypoints(one)) {
      ++boxes;
      continue;
    }
    ASSIGN_OR_RETURN(ListedPerson listed, PointsOf(one, place));
    for (const Keypoint& point : listed.points) largest = std::max(largest, point.confidence);
    if (numbered[*number].size() >= kMaxPeople) return Fail(place, "found more than {} people in a frame", kMaxPeople);
    numbered[*number].push_back(std::move(listed));
  }
  if (numbered.empty()) return Fail(place, "none of {} results has a list 'keypoints'", boxes);
  // Scale confidences of up to 2 to 0…1, and order the landmarks. ReadKeypoints scales larger ones.
  const double scale = largest <= kMaxFlag ? std::max(1.0, largest) : 1;
  std::map<long, std::vector<SeenPerson>> people;
  for (auto& [number, persons] : numbered) {
    for (ListedPerson& listed : persons) {
      for (Keypoint& point : listed.points) point.confidence /= scale;
      ASSIGN_OR_RETURN(const SeenPerson person, ToPerson(listed.points, layout, listed.names, place));
      people[number].push_back(person);
    }
  }
  ASSIGN_OR_RETURN(auto film, FilmOfNumbers(std::move(people), of, place));
  if (boxes > 0) film.Tell(fmt::format("Etude left out results without keypoints: {}", boxes));
  return film;
}

}  // namespace

Result<PeopleOfFilm> ReadKeypointList(const Json& json, const std::string& layout, const FilmOfKeypoints& of,
                                      const Place& place) {
  if (IsOfImages(json)) {
    ASSIGN_OR_RETURN(auto film, ReadResults(ResultsOfImages(json), layout, of, place));
    // AlphaPose computes the neck of these formats only for models with 17 keypoints. For other models, it writes
    // keypoint 17, which is the top of the head or a toe.
    if (!FitsClearly(film.frames)) {
      film.Tell(
          "the neck is not midway between the shoulders; use AlphaPose's usual format for models of more than 17 "
          "keypoints");
    }
    return film;
  }
  const Json& list = json.is_array() ? json : *FirstMember(json, {"instance_info", "frames"});
  if (list.empty()) return Fail(place, "the list of frames is empty");
  if (Member(list.front(), "image_id") != nullptr) return ReadResults(list, layout, of, place);
  const KeypointNames names = NamesOfMeta(json);
  const auto number_of = [](const Json& frame) {
    return FirstMember(frame, {"frame_id", "frame", "frame_index", "frame_idx", "frame_number", "frame_num", "frame_no",
                               "frameIndex", "frameNumber", "frameId", "frame_nr", "image_number"});
  };
  const bool has_numbers = number_of(list.front()) != nullptr;
  std::map<long, std::vector<SeenPerson>> numbered;
  PeopleOfFilm film;
  std::vector<double> times;
  // Read the number, or the time, and the people of every frame.
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& frame = list[i];
    const Json* id = number_of(frame);
    const auto number = id != nullptr ? FrameNumber(*id) : std::nullopt;
    if (id != nullptr && !number) return Fail(place, "frame {} is not a number", ShowJson(*id));
    if (!has_numbers && frame.is_object()) {
      for (const auto& [key, value] : frame.items()) {
        const Json* first = Member(list.front(), key.c_str());
        const bool may_be_number = key.starts_with("frame") && value.is_number_integer() && first && value != *first;
        if (may_be_number)
          return Fail(place, "the key '{}' of entry {} may be a frame number; allowed: the key frame_id", key, i);
      }
    }
    if (number.has_value() != has_numbers) {
      return Fail(place,
                  "entry {} has {} frame number, but the first entry has {}; allowed: a frame number in all entries or "
                  "in no entry",
                  i, number ? "a" : "no", has_numbers ? "one" : "none");
    }
    const Json* people = frame.is_object()
                             ? FirstMember(frame, {"instances", "people", "pose_landmarks", "landmarks", "keypoints"})
                             : &frame;
    if (people == nullptr) {
      return Fail(place, "frame {} has none of the keys instances, people, pose_landmarks, landmarks and keypoints", i);
    }
    ASSIGN_OR_RETURN(auto seen, PeopleOfList(*people, layout, names, place));
    if (const auto time = TimeOf(frame)) times.push_back(*time);
    if (!number) {
      film.frames.push_back(std::move(seen));
      continue;
    }
    // A list may have one entry for each person.
    std::vector<SeenPerson>& all = numbered[*number];
    if (all.size() + seen.size() > kMaxPeople) return Fail(place, "found more than {} people in a frame", kMaxPeople);
    all.insert(all.end(), seen.begin(), seen.end());
  }
  if (has_numbers) return FilmOfNumbers(std::move(numbered), of, place);
  if (times.size() == list.size() && of.frames != list.size()) LayByTimes(times, of, film);
  return film;
}

}  // namespace etude
