#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/base/image.h"
#include "engine/cameras/limb_direction.h"
#include "engine/motion/body.h"

namespace etude {

/// The mark of one limb in an annotation picture (paper B, section 4.2: one colour per limb): a stroke from `from` to
/// `to`, in two shades (ours), so that the picture tells which end is which.
struct StrokeMark {
  Role from;
  Role to;
  Rgb8 first_half;
  Rgb8 second_half;
};

/// The mark of the tip of a limb: a disc.
struct EffectorMark {
  Role role;
  Rgb8 colour;
};

constexpr std::size_t kStrokeCount = 13;
constexpr std::size_t kEffectorCount = 5;

/// Returns the strokes of the limbs that paper B needs (section 3.2): legs and arms from the trunk outwards, and the
/// neck (the hip and shoulder lines follow from the joints). No two colours of the palette are equal, none is black.
std::span<const StrokeMark, kStrokeCount> StrokeMarks();
/// Returns the discs: left foot (the root), right foot, left hand, right hand, head.
std::span<const EffectorMark, kEffectorCount> EffectorMarks();

/// The width of strokes and the radius of discs, pixels; marks are drawn on black with hard edges: strokes first, discs
/// over them.
constexpr double kStrokeWidth = 3;
constexpr double kDiscRadius = 4;

/// The marks of an annotation picture; nothing where a mark is missing or cannot be read any more.
struct Marks {
  std::array<std::optional<PixelSegment>, kStrokeCount> strokes;  ///< from `from` to `to`
  std::array<std::optional<glm::dvec2>, kEffectorCount> effectors;
};

/// Reads the marks of one picture back. A stroke gives the line through its visible pixels (their
/// principal axis) and, from its shades, its sense; it is missing when one shade is wholly covered. A
/// disc gives its centre, also when partly covered: the middle of all centres from which a disc of that
/// radius covers every visible pixel.
Marks ReadMarks(const ColourImage& annotation);

}  // namespace etude
