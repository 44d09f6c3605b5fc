#include "io/keypoints/coco_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "io/keypoints/frame_numbers.h"
#include "io/keypoints/people_json.h"

namespace etude {
namespace {

constexpr double kMaxPixel = 1e6;

/// The images of a data set, in the order of the frames.
struct CocoImages {
  std::map<double, std::size_t> frames;  ///< by the image's id
  std::vector<std::string> names;        ///< of each frame, without its folder
};

/// Reads the images' size, and the order in which they are frames.
Result<CocoImages> ImagesOf(const Json& images, PeopleOfFilm& film, const Place& place) {
  CocoImages read;
  std::vector<double> ids;
  std::vector<std::string> names;
  for (const Json& image : images) {
    names.push_back(TextOf(Member(image, "file_name")));
    const auto id = NumberOf(Member(image, "id"));
    if (!id) return Fail(place, "found an image without a number 'id'");
    if (!read.frames.try_emplace(*id, 0).second) {
      return Fail(place, "found two images with the id {}", Member(image, "id")->dump());
    }
    ids.push_back(*id);
    const auto width = NumberOf(Member(image, "width")), height = NumberOf(Member(image, "height"));
    if (width && height) {
      const int w = static_cast<int>(std::clamp(*width, 0.0, kMaxPixel));
      const int h = static_cast<int>(std::clamp(*height, 0.0, kMaxPixel));
      if (film.width != 0 && (w != film.width || h != film.height)) {
        return Fail(place, "one film has images of {} x {} and of {} x {} pixels; allowed: one size", film.width,
                    film.height, w, h);
      }
      film.width = w;
      film.height = h;
    }
  }
  // Order the images.
  std::vector<std::size_t> order(ids.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const bool are_numbered = AreNumbered(names);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return are_numbered ? NaturallyBefore(names[a], names[b]) : ids[a] < ids[b];
  });
  if (!std::ranges::is_sorted(order)) {
    film.Tell(fmt::format("the file lists the images in another order than {}; Etude uses the order of {}",
                          are_numbered ? "the numbers in their names" : "their ids",
                          are_numbered ? "these numbers" : "the ids"));
  }
  for (const std::size_t i : order) {
    read.frames[ids[i]] = read.names.size();
    read.names.push_back(std::filesystem::path(names[i]).filename().string());
  }
  return read;
}

/// A category of annotations, and what became of them.
struct CocoCategory {
  std::string name;
  KeypointNames keypoints;
  double max_confidence = 0;
  bool are_whole = true;  ///< true: all confidences are whole numbers
  std::size_t read = 0;
  std::size_t refused = 0;
  Error error;  ///< why the first of `refused` was refused
};

using CocoCategories = std::map<double, CocoCategory>;

CocoCategories CategoriesOf(const Json& json) {
  CocoCategories categories;
  const Json* list = Member(json, "categories");
  if (list == nullptr || !list->is_array()) return categories;
  for (const Json& one : *list) {
    CocoCategory& category = categories[NumberOf(Member(one, "id")).value_or(0)];
    category.keypoints = KeypointNames(TextsOf(Member(one, "keypoints")));
    if (const std::string name = TextOf(Member(one, "name")); !name.empty()) category.name = name;
  }
  return categories;
}

/// Returns the category of an annotation. If the annotation states none that is listed, that is `only`, the only listed
/// category; if `only` is null, a category without names.
CocoCategory& CategoryOf(const Json& annotation, CocoCategory* only, CocoCategories& categories) {
  constexpr double kNoId = -1;
  const double number = NumberOf(Member(annotation, "category_id")).value_or(kNoId);
  const auto found = categories.find(number);
  if (found != categories.end()) return found->second;
  return only != nullptr ? *only : categories[number];
}

struct CocoPerson {
  std::size_t frame;
  CocoCategory* category;
  std::vector<Keypoint> points;  ///< the points; `confidence` holds COCO's visibility flag v
};

/// Puts the people into their frames. People of a category of which nobody can be read are left out, unless that leaves
/// nobody.
Result<void> AddPeople(std::vector<CocoPerson> people, const std::string& layout, CocoCategories& categories,
                       PeopleOfFilm& film, const Place& place) {
  for (CocoPerson& person : people) {
    CocoCategory& category = *person.category;
    // Whole numbers up to 2 are COCO's flags; otherwise the values are scores.
    const bool are_flags = category.max_confidence == kMaxFlag && category.are_whole;
    for (Keypoint& point : person.points) point.confidence /= are_flags ? kMaxFlag : 1;
    auto seen = ToPerson(person.points, layout, category.keypoints, place);
    if (!seen) {
      if (category.refused++ == 0) category.error = std::move(seen).error();
      continue;
    }
    ++category.read;
    if (film.frames[person.frame].size() >= kMaxPeople)
      return Fail(place, "found more than {} people in a frame", kMaxPeople);
    film.frames[person.frame].push_back(*seen);
  }
  const bool is_any_read = std::ranges::any_of(categories, [](const auto& one) { return one.second.read > 0; });
  for (const auto& [id, category] : categories) {
    if (category.refused == 0) continue;
    if (category.read > 0 || !is_any_read) return tl::unexpected(category.error);
    film.Tell(fmt::format(
        "Etude left out annotations of the category {}, because their keypoints are not those of a person: {}",
        category.name.empty() ? fmt::format("{:g}", id) : category.name, category.refused));
  }
  return {};
}

}  // namespace

Result<PeopleOfFilm> ReadCoco(const Json& json, const std::string& layout, const FilmOfKeypoints& of,
                              const Place& place) {
  const Json *images = Member(json, "images"), *annotations = Member(json, "annotations");
  if (images == nullptr || !images->is_array() || annotations == nullptr || !annotations->is_array()) {
    return Fail(place,
                "the lists 'images' and 'annotations' are missing; allowed: keypoint files or results of COCO, "
                "AlphaPose or MMPose, landmarks of MediaPipe, or a folder of OpenPose's JSON files");
  }
  PeopleOfFilm film;
  CocoCategories categories = CategoriesOf(json);
  CocoCategory* only = categories.size() == 1 ? &categories.begin()->second : nullptr;
  ASSIGN_OR_RETURN(const CocoImages listed, ImagesOf(*images, film, place));
  // Collect the people of every image.
  std::vector<CocoPerson> people;
  std::size_t boxes = 0;
  for (const Json& annotation : *annotations) {
    const auto id = NumberOf(Member(annotation, "image_id"));
    const auto frame = id ? listed.frames.find(*id) : listed.frames.end();
    if (frame == listed.frames.end())
      return Fail(place, "an annotation belongs to an image that the list 'images' does not contain");
    if (!HasKeypoints(annotation)) {
      ++boxes;
      continue;
    }
    ASSIGN_OR_RETURN(auto points, Triples(Member(annotation, "keypoints"), place));
    CocoCategory& category = CategoryOf(annotation, only, categories);
    for (const Keypoint& point : points) {
      category.max_confidence = std::max(category.max_confidence, point.confidence);
      category.are_whole = category.are_whole && point.confidence == std::floor(point.confidence);
    }
    people.push_back({frame->second, &category, std::move(points)});
  }
  film.frames.resize(listed.frames.size());
  if (film.frames.empty()) return Fail(place, "no image");
  if (people.empty() && boxes > 0) return Fail(place, "none of {} annotations has a list 'keypoints'", boxes);
  if (boxes > 0) film.Tell(fmt::format("Etude left out annotations without keypoints: {}", boxes));
  RETURN_IF_ERROR(AddPeople(std::move(people), layout, categories, film, place));
  LayByNames(listed.names, of, film);
  return film;
}

}  // namespace etude
