#pragma once

#include <string>

#include "io/files/json.h"
#include "io/keypoints/read_people.h"

namespace etude {

/// Reads a COCO data set: lists `images` and `annotations`. An annotation's category names its keypoints. The images
/// are frames in the order of the numbers in their names or, if the names are not numbered, of their ids; `told` says
/// if they are listed in another order. Annotations without keypoints, and those of a category whose keypoints are
/// never a person's, are left out, and `told` says so. Fails if then none is left, or if the lists contradict each
/// other.
Result<PeopleOfFilm> ReadCoco(const Json& json, const std::string& layout, const FilmOfKeypoints& of,
                              const Place& place);

}  // namespace etude
