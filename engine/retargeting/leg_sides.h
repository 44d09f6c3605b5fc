#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

namespace etude {

/// Evidence of the legs that left and right are not exchanged (ours). Each leg is measured against its own shank and
/// against the line of the hips, so the body may stand, kneel, lie or bend backwards. If a shank is parallel to the
/// line of the hips, as in people who sit cross-legged, the leg counts as 0.
class LegSides {
 public:
  /// Adds one leg of one frame. `left` points from the right hip to the left hip. Legs without a length do not count.
  void Add(const glm::dvec3& left, const glm::dvec3& hip, const glm::dvec3& knee, const glm::dvec3& ankle,
           const glm::dvec3& toe);

  /// Returns the mean share of a foot that points to the front of its shank, from −1 (backwards) to 1; near 0 if the
  /// toes point down the shank, as in people who kneel. Returns nullopt if there was no foot.
  std::optional<double> FeetForward() const;

  /// Returns "the feet point backwards"; or, if the feet are undecided, "the knees bend backwards"; otherwise "".
  std::string_view Backwards() const;

 private:
  double feet_ = 0, knees_ = 0;  // sums over legs and frames; knees: sines of bends, without slight backward ones
  int count_ = 0;
};

}  // namespace etude
