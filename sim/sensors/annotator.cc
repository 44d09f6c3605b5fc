#include "sim/sensors/annotator.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace etude {
namespace {

// The pixels of `picture` that may lie within `reach` of the box around a and b.
struct Box {
  int x0, x1, y0, y1;  // half open
};

Box BoxAround(const glm::dvec2& a, const glm::dvec2& b, double reach, const ColourImage& picture) {
  auto cut = [](double value, int size) { return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size))); };
  return {cut(std::floor(std::min(a.x, b.x) - reach), picture.width),
          cut(std::ceil(std::max(a.x, b.x) + reach) + 1, picture.width),
          cut(std::floor(std::min(a.y, b.y) - reach), picture.height),
          cut(std::ceil(std::max(a.y, b.y) + reach) + 1, picture.height)};
}

bool IsOnPerson(const Mask& person, const glm::dvec2& pixel, int margin) {
  const glm::dvec2 corner = glm::floor(pixel);
  if (!(std::abs(corner.x) < 1e6 && std::abs(corner.y) < 1e6)) return false;
  const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
  for (int v = y - margin; v <= y + margin; ++v) {
    for (int u = x - margin; u <= x + margin; ++u) {
      if (person.Contains(u, v) && person.At(u, v) != 0) return true;
    }
  }
  return false;
}

// One frame as the annotator sees it.
struct Scene {
  const BodyPose& truth;
  const std::vector<Capsule>& body;
  const Camera& camera;
  const Mask& person;
  const AnnotatorOptions& options;

  // Where the hand puts a mark that is meant for `role`; nothing when the joint is not before the camera.
  std::optional<glm::dvec2> Aim(Role role, RandomStream& random) const {
    const glm::dvec2 shake(random.Normal(), random.Normal());  // thrown even when not used
    const auto pixel = Project(camera, truth[role]);
    if (!pixel) return std::nullopt;
    const bool hidden = IsHidden(body, truth, role, camera.p_WC);
    return *pixel + options.error_px * (hidden ? options.hidden_factor : 1) * shake;
  }

  bool ShowsLimb(const StrokeMark& mark) const {
    constexpr int kSamples = 16;
    int shown = 0;
    for (int i = 0; i < kSamples; ++i) {
      const glm::dvec3 point = glm::mix(truth[mark.from], truth[mark.to], (i + 0.5) / kSamples);
      const auto pixel = Project(camera, point);
      shown += pixel && IsOnPerson(person, *pixel, options.margin_px);
    }
    return shown >= options.visible_share * kSamples;
  }
};

}  // namespace

void DrawStroke(const PixelSegment& segment, const StrokeMark& mark, ColourImage& picture) {
  const glm::dvec2 along = segment.b - segment.a;
  const double length2 = glm::dot(along, along);
  constexpr double kPen = kStrokeWidth / 2;
  const Box box = BoxAround(segment.a, segment.b, kPen, picture);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const glm::dvec2 centre(x + 0.5, y + 0.5);
      const double t = length2 > 0 ? std::clamp(glm::dot(centre - segment.a, along) / length2, 0.0, 1.0) : 0;
      const glm::dvec2 off = centre - (segment.a + t * along);
      if (glm::dot(off, off) <= kPen * kPen) picture.At(x, y) = t < 0.5 ? mark.first_half : mark.second_half;
    }
  }
}

void DrawDisc(const glm::dvec2& centre, const EffectorMark& mark, ColourImage& picture) {
  const Box box = BoxAround(centre, centre, kDiscRadius, picture);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const glm::dvec2 off = glm::dvec2(x + 0.5, y + 0.5) - centre;
      if (glm::dot(off, off) <= kDiscRadius * kDiscRadius) picture.At(x, y) = mark.colour;
    }
  }
}

ColourImage Annotate(const BodyPose& truth, const std::vector<Capsule>& body, const Camera& camera, const Mask& person,
                     const AnnotatorOptions& options, RandomStream& random) {
  const Scene scene{truth, body, camera, person, options};
  ColourImage picture(person.width, person.height);
  for (const StrokeMark& mark : StrokeMarks()) {
    const auto from = scene.Aim(mark.from, random), to = scene.Aim(mark.to, random);
    if (from && to && scene.ShowsLimb(mark)) DrawStroke({*from, *to}, mark, picture);
  }
  for (const EffectorMark& mark : EffectorMarks()) {
    const auto centre = scene.Aim(mark.role, random);
    if (!centre) continue;
    const auto true_pixel = Project(camera, truth[mark.role]);
    if (IsOnPerson(person, *true_pixel, options.margin_px)) DrawDisc(*centre, mark, picture);
  }
  return picture;
}

}  // namespace etude
