#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A motion of any body: the position of each joint in each frame, metres; NaN if the joint is not seen. Axes and
/// origin are arbitrary.
struct Places {
  std::size_t frames = 0, joints = 0;
  std::function<glm::dvec3(std::size_t frame, std::size_t joint)> at;
};

/// `motion` must outlive the result.
Places PlacesOf(const BodyMotion& motion);

/// Returns the positions of up to `max_joints` joints in up to `max_frames` frames, evenly chosen.
std::vector<glm::dvec3> SketchOf(const Places& places, std::size_t max_frames = 12, std::size_t max_joints = 30);

/// Returns true if one rigid motion of the whole take moves all positions of one onto those of the other, to within a
/// millimetre, in all frames and joints: two files of one motion may differ by rounding, a rotation and a translation.
bool AreEqual(const Places& a, const Places& b);

/// Finds equal motions among `count` ones. Returns, for each, the first motion that it equals; nothing for the first
/// one itself and for motions without an equal. Two motions are equal if their sketches (SketchOf) are equal and
/// `are_equal` returns true, which must compare all frames. An empty sketch equals no other.
std::vector<std::optional<std::size_t>> FindEqual(std::size_t count,
                                                  const std::function<std::vector<glm::dvec3>(std::size_t)>& sketch_of,
                                                  const std::function<bool(std::size_t, std::size_t)>& are_equal);

/// Finds equal motions among motions in memory, with SketchOf and AreEqual.
std::vector<std::optional<std::size_t>> FindEqual(const std::vector<Places>& motions);

/// Removes the entry of each motion that equals an earlier one (FindEqual).
template <typename List>
void EraseEqual(List& list, const std::vector<std::optional<std::size_t>>& equals) {
  std::size_t m = 0;
  std::erase_if(list, [&](const auto&) { return equals[m++].has_value(); });
}

}  // namespace etude
