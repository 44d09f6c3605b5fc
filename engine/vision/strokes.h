#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/base/image.h"
#include "engine/cameras/limb_direction.h"
#include "engine/motion/body.h"

namespace etude {

/// The mark of one limb in an annotation picture (paper B, section 4.2: one colour for each limb). It is a stroke from
/// `from` to `to`; two shades (ours) distinguish its halves.
struct StrokeMark {
  Role from;
  Role to;
  Rgb8 first_half;
  Rgb8 second_half;
};

/// The mark of an end effector: a disc.
struct EffectorMark {
  Role role;
  Rgb8 colour;
};

constexpr std::size_t kStrokeCount = 13;
constexpr std::size_t kEffectorCount = 5;

/// Returns the strokes of the limbs that paper B needs (section 3.2): legs and arms from the trunk outwards, and the
/// neck. (The lines of hips and shoulders follow from the joints.) All colours of marks are different, and no colour is
/// black.
std::span<const StrokeMark, kStrokeCount> StrokeMarks();
/// Returns the discs of left foot (the root), right foot, left hand, right hand and head.
std::span<const EffectorMark, kEffectorCount> EffectorMarks();

/// The width of strokes and the radius of discs, pixels. Marks are drawn on black with hard edges, strokes first, discs
/// on top.
constexpr double kStrokeWidth = 3;
constexpr double kDiscRadius = 4;

/// The marks of one annotation picture; nullopt for a mark that is missing or unreadable.
struct Marks {
  std::array<std::optional<PixelSegment>, kStrokeCount> strokes;  ///< pixels, from StrokeMark::from to StrokeMark::to
  std::array<std::optional<glm::dvec2>, kEffectorCount> effectors;
};

/// Reads the marks of one picture. A stroke is the principal axis of its visible pixels, and the stroke's two shades
/// determine its direction. A stroke is missing if one shade is completely covered. A disc is represented by its
/// centre: the mean of all centres for which a disc of the marks' radius contains every visible pixel. This rule also
/// locates discs that are partly covered.
Marks ReadMarks(const ColourImage& annotation);

}  // namespace etude
