#include "engine/vision/limb_evidence.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/vision/limb_regions.h"
#include "engine/vision/scatter.h"

namespace etude {
namespace {

/// The picture feature that locates a limb's inner joint.
enum class Landmark {
  kBorder,     ///< the middle of the border between the limb and its parent part
  kBorderEnd,  ///< the border's end that is farthest along the limb: for a thigh, the crotch
  kInnerEnd,   ///< the inner end of the limb's visible part
};

/// The typical proportions of a limb *(ours)*, in units of half the limb's width.
struct Anatomy {
  double length;   ///< length of the bone, for a limb seen from the side
  double joint;    ///< distance from the landmark outwards to the inner joint
  double tip = 1;  ///< distance from the visible outer end inwards to the joint or tip
  Landmark landmark = Landmark::kBorder;
};
using Body = std::array<Anatomy, kStrokeCount>;

constexpr Body BodyOf(Anatomy thigh, Anatomy shank, Anatomy foot, Anatomy upper_arm, Anatomy forearm, Anatomy hand,
                      Anatomy head) {
  return {thigh, shank, foot, thigh, shank, foot, upper_arm, forearm, hand, upper_arm, forearm, hand, head};
}

/// The proportions of the figure made of capsules. A joint on the trunk (hip, shoulder) is located from the limb that
/// begins there, and every other joint from the round end of the previous limb.
constexpr Body kCapsules = BodyOf({6, -0.94}, {8, 0}, {6, 0}, {6.5, -1.04}, {7, 0}, {5.5, 0}, {1, -0.35});
constexpr Body kDressed =
    BodyOf({6, -1.55, 1, Landmark::kBorderEnd}, {8, -0.5}, {6, 0, 0.62}, {6.5, 0.97, 1, Landmark::kInnerEnd},
           {7, 0.28, 1, Landmark::kInnerEnd}, {5.5, 0.43, 0.76}, {1, -0.1});

constexpr const Body& BodyOf(FigureKind kind) { return kind == FigureKind::kDressed ? kDressed : kCapsules; }
constexpr std::size_t kHeadStroke = kStrokeCount - 1;
constexpr std::size_t kMinPixels = 6;   // smaller regions are noise
constexpr std::size_t kMinBorder = 3;   // minimum length of a border in pixel sides
constexpr double kMinSeenShare = 0.25;  // minimum visible share of a limb of which one end was not found

/// The border between a limb and its parent part in the picture.
struct Border {
  glm::dvec2 middle{0};
  double half_breadth = 0;
  bool limb_covers = false;  ///< the limb is in front of its parent part
};

// Measures the middle and the breadth of a border, and whether the limb covers its parent part: the border's ends bend
// towards the part in front.
Border MeasureBorder(const std::vector<glm::dvec2>& points, const glm::dvec2& limb_middle) {
  Border border;
  for (const glm::dvec2& p : points) border.middle += p / static_cast<double>(points.size());
  // Find the border's direction by its principal axis.
  Scatter scatter;
  for (const glm::dvec2& p : points) scatter.Add(p - border.middle);
  const glm::dvec2 along = scatter.Axis();
  glm::dvec2 to_limb(-along.y, along.x);
  if (glm::dot(limb_middle - border.middle, to_limb) < 0) to_limb = -to_limb;
  const double mean_square = scatter.AlongAxis() / static_cast<double>(points.size());
  // Sum up the bend: how much farther the border's end points lie on the limb's side than the border's middle points.
  double bend = 0, low = 0, high = 0;
  for (const glm::dvec2& p : points) {
    const glm::dvec2 d = p - border.middle;
    const double s = glm::dot(d, along);
    low = std::min(low, s);
    high = std::max(high, s);
    bend += (s * s - mean_square) * glm::dot(d, to_limb);
  }
  border.half_breadth = 0.5 * (high - low + 1);
  border.limb_covers = bend > 0;
  return border;
}

class EvidenceFinder {
 public:
  EvidenceFinder(const LimbRegions& regions, const FigureLook& look)
      : regions_(regions), look_(look), body_(BodyOf(look.figure)) {
    for (std::size_t i = 0; i < kStrokeCount; ++i) Look(i);
  }

  PictureEvidence Find() {
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      if (limbs_[i]) SetInnerJoint(i);
    }
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      if (limbs_[i]) SetTip(i);
    }
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      if (limbs_[i]) evidence_.limbs[i] = LineOf(i);
    }
    return evidence_;
  }

 private:
  struct Limb {
    const Region* region;
    MiddleLine line;              ///< `along` points outwards
    std::optional<Border> inner;  ///< border between the limb and its parent part
    std::optional<Border> outer;  ///< border between the limb and its child part
  };

  static bool HasOuterLimb(std::size_t i) { return i != kHeadStroke && i % 3 != 2; }

  // Measures the line and borders of limb `i`, and stores the limb if its direction can be determined.
  void Look(std::size_t i) {
    const Region& region = regions_.limbs[i];
    if (region.pixels < static_cast<int>(kMinPixels)) return;
    Limb limb{&region, FindMiddleLine(region), BorderOf(i), std::nullopt};
    if (HasOuterLimb(i)) limb.outer = BorderOf(i + 1);
    if (!TurnOutwards(i, limb)) return;
    limbs_[i] = limb;
  }

  std::optional<Border> BorderOf(std::size_t i) const {
    const auto& points = regions_.borders[i];
    if (points.size() < kMinBorder) return std::nullopt;
    return MeasureBorder(points, regions_.limbs[i].middle);
  }

  // Orients the limb outwards; returns false if its outer end cannot be determined.
  bool TurnOutwards(std::size_t i, Limb& limb) const {
    // Use the first kind of evidence that is available; the most reliable kind comes first.
    glm::dvec2 outwards(0);
    const Region& inner_part = IsAttachedToTrunk(i) ? regions_.trunk : regions_.limbs[i - 1];
    const Region& trunk = regions_.trunk;
    const bool ends_there = EndsAt(limb, limb.outer);
    const auto from_neck = ends_there ? std::nullopt : AwayFromNeck(i, limb);
    if (from_neck) {
      outwards = *from_neck;
    } else if (ends_there || (limb.outer && (!limb.inner || RunsAlong(limb)))) {
      outwards = limb.outer->middle - limb.region->middle;
    } else if (limb.inner && limb.outer) {
      outwards = limb.outer->middle - limb.inner->middle;
    } else if (limb.inner) {
      outwards = limb.region->middle - limb.inner->middle;
    } else if (inner_part.pixels > 0) {
      outwards = limb.region->middle - inner_part.middle;
    } else if (HasOuterLimb(i) && regions_.limbs[i + 1].pixels > 0) {
      outwards = regions_.limbs[i + 1].middle - limb.region->middle;
    } else if (trunk.pixels > 0) {
      outwards = limb.region->middle - trunk.middle;
    } else {
      return false;
    }
    if (i == kHeadStroke && limb.inner && glm::length(outwards) > 1) {
      // The head is too round for a principal axis, so use the direction from the neck.
      const double half_width = limb.line.half_width;
      limb.line = AlongFrom(*limb.region, limb.inner->middle, outwards);
      limb.line.half_width = half_width;
      return true;
    }
    // Reverse the line if it points inwards.
    if (glm::dot(outwards, limb.line.along) < 0) {
      limb.line.along = -limb.line.along;
      limb.line = {limb.line.origin, limb.line.along, -limb.line.high, -limb.line.low, limb.line.half_width};
    }
    return true;
  }

  static MiddleLine AlongFrom(const Region& region, const glm::dvec2& from, const glm::dvec2& direction) {
    MiddleLine line{.origin = from, .along = glm::normalize(direction), .low = 1e9, .high = -1e9};
    for (const PixelRun& run : region.runs) {
      for (const double x : {run.x0 + 0.5, run.x1 - 0.5}) {
        const double s = line.Where({x, run.y + 0.5});
        line.low = std::min(line.low, s - 0.5);
        line.high = std::max(line.high, s + 0.5);
      }
    }
    return line;
  }

  // Returns true if the picture's edge cuts off the limb's outer end.
  bool IsCutOff(const Limb& limb) const {
    if (!limb.region->is_cut) return false;
    const glm::dvec2 end = limb.line.At(limb.line.high);
    const double reach = limb.line.half_width + 1;
    return end.x < reach || end.y < reach || end.x > regions_.width - reach || end.y > regions_.height - reach;
  }

  // For an upper arm, returns its direction away from the neck; nullopt for other limbs, or if both ends are equally
  // far from the neck. The borders of an upper arm may run along the arm, because the arm touches the flank or the
  // folded forearm; but the shoulder is always the end nearer to the neck.
  std::optional<glm::dvec2> AwayFromNeck(std::size_t i, const Limb& limb) const {
    const bool is_upper_arm =
        StrokeMarks()[i].from == Role::kLeftShoulder || StrokeMarks()[i].from == Role::kRightShoulder;
    const auto& neck_border = regions_.borders[kHeadStroke];
    if (!is_upper_arm || neck_border.empty() || !limb.line.IsLong()) return std::nullopt;
    const glm::dvec2 neck = neck_border[neck_border.size() / 2];
    const double to_low = glm::distance(neck, limb.line.At(limb.line.low));
    const double to_high = glm::distance(neck, limb.line.At(limb.line.high));
    if (std::abs(to_low - to_high) < limb.line.half_width) return std::nullopt;
    return to_low < to_high ? limb.line.along : -limb.line.along;
  }

  // Returns true if the border lies across one end of the limb.
  static bool EndsAt(const Limb& limb, const std::optional<Border>& border) {
    constexpr double kNearEnd = 0.3, kAcross = 1.5;
    const double middle = 0.5 * (limb.line.low + limb.line.high);
    return border && limb.line.IsLong() && border->half_breadth < kAcross * limb.line.half_width &&
           std::abs(limb.line.Where(border->middle) - middle) > kNearEnd * (limb.line.high - limb.line.low);
  }

  // Returns true if the limb's side touches its parent part, as a hanging arm touches the flank.
  static bool RunsAlong(const Limb& limb) {
    constexpr double kSide = 1.5;
    return limb.line.IsLong() && limb.inner->half_breadth > kSide * limb.line.half_width;
  }

  // Returns the centre of the limb's round outer end: `inset` pixels inward of the visible end, at most to the middle.
  static glm::dvec2 RoundEnd(const MiddleLine& line, double inset) {
    return line.At(std::max(0.5 * (line.low + line.high), line.high - inset));
  }

  // Returns how far a limb is visible beyond its outer joint, in pixels along the limb. The limb ends in a disc around
  // the joint, whose radius is the limb's half width. The thinner limb `next` begins at the joint, continues at an
  // angle, and covers a strip of the disc: `next`'s half width on each side of its line.
  static double ReachBeyondJoint(const MiddleLine& limb, const MiddleLine& next) {
    if (!next.IsLong()) return limb.half_width;
    const double between = std::acos(std::clamp(glm::dot(limb.along, next.along), -1.0, 1.0));
    const double strip = std::asin(std::min(1.0, next.half_width / limb.half_width));
    return between >= strip ? limb.half_width : limb.half_width * std::cos(strip - between);
  }

  void SetInnerJoint(std::size_t i) {
    const Limb& limb = *limbs_[i];
    if (!limb.inner) return;
    std::optional<glm::dvec2>& joint = evidence_.joints[Index(StrokeMarks()[i].from)];
    if (i == kHeadStroke) {
      joint = limb.inner->middle + body_[i].joint * limb.inner->half_breadth * limb.line.along;
    } else if (look_.figure == FigureKind::kDressed) {
      joint = DressedJoint(i, limb);
    } else {
      joint = CapsuleJoint(i, limb);
    }
  }

  std::optional<glm::dvec2> CapsuleJoint(std::size_t i, const Limb& limb) const {
    const Border& border = *limb.inner;
    const double beyond = body_[i].joint * limb.line.half_width;
    if (border.limb_covers && !limb.line.IsLong()) return MiddleOf(limb.line);  // the limb lies along the line of sight
    if (IsAttachedToTrunk(i)) {
      if (RunsAlong(limb)) return limb.line.At(limb.line.low + beyond);
      const glm::dvec2 outwards = limb.line.IsLong() ? limb.line.along : Unit(limb.region->middle - border.middle);
      return border.middle + beyond * outwards;
    }
    if (!limbs_[i - 1]) return std::nullopt;
    const MiddleLine& before = limbs_[i - 1]->line;
    return RoundEnd(before, ReachBeyondJoint(before, limb.line));
  }

  glm::dvec2 DressedJoint(std::size_t i, const Limb& limb) const {
    if (!limb.line.IsLong()) return limb.inner->middle;
    const double beyond = body_[i].joint * limb.line.half_width;
    switch (body_[i].landmark) {
      case Landmark::kBorderEnd:
        return limb.line.At(BorderEnd(i, limb.line) + beyond);
      case Landmark::kInnerEnd:
        return limb.line.At(limb.line.low + beyond);
      case Landmark::kBorder:
        // If a limb is folded over the previous limb, the border runs along the limb's side. Such a border does not
        // show the limb's end.
        return RunsAlong(limb) ? limb.line.At(limb.line.low) : limb.inner->middle + beyond * limb.line.along;
    }
    return limb.inner->middle;
  }

  double BorderEnd(std::size_t i, const MiddleLine& line) const {
    double farthest = line.low;
    for (const glm::dvec2& p : regions_.borders[i]) farthest = std::max(farthest, line.Where(p));
    return farthest;
  }

  static glm::dvec2 MiddleOf(const MiddleLine& line) { return line.At(0.5 * (line.low + line.high)); }

  void SetTip(std::size_t i) {
    if (HasOuterLimb(i)) return;
    const Limb& limb = *limbs_[i];
    if (IsCutOff(limb)) return;
    std::optional<glm::dvec2>& tip = evidence_.joints[Index(StrokeMarks()[i].to)];
    tip = i == kHeadStroke ? limb.line.At(limb.line.high - look_.head_below_crown * limb.line.half_width)
                           : RoundEnd(limb.line, body_[i].tip * limb.line.half_width);
  }

  std::optional<LimbEvidence> LineOf(std::size_t i) const {
    const Limb& limb = *limbs_[i];
    const auto& inner = evidence_.joints[Index(StrokeMarks()[i].from)];
    const auto& outer = evidence_.joints[Index(StrokeMarks()[i].to)];
    LimbEvidence seen;
    seen.contrast = limb.region->contrast;
    seen.half_width = limb.line.half_width;
    const double half_width = LikelyHalfWidth(i);
    const double whole = half_width * half_width * (2 * body_[i].length + kPi);
    seen.seen_share = std::min(1.0, limb.region->pixels / whole);
    const bool is_long = limb.line.high - limb.line.low > 3 * half_width;
    if (!(inner && outer) && (seen.seen_share < kMinSeenShare || !is_long)) return std::nullopt;
    // End the stroke at a joint if this limb has a border there, or at the tip of an outermost limb. Any other joint is
    // known from the neighbouring limb alone, so the stroke ends with this limb's region.
    seen.line.a = inner && limb.inner ? *inner : limb.line.At(limb.line.low);
    seen.line.b = outer && (limb.outer || !HasOuterLimb(i)) ? *outer : limb.line.At(limb.line.high);
    return seen;
  }

  // Returns the limb's probable half width. One side of the limb may be hidden along the whole length. So the result is
  // at least the outer neighbour's half width, and at least a share of the inner neighbour's half width.
  double LikelyHalfWidth(std::size_t i) const {
    constexpr double kMinWidthRatio = 0.55;  // a foot's width as a share of the shank's width
    double half_width = limbs_[i]->line.half_width;
    if (HasOuterLimb(i) && limbs_[i + 1]) half_width = std::max(half_width, limbs_[i + 1]->line.half_width);
    if (!IsAttachedToTrunk(i) && limbs_[i - 1])
      half_width = std::max(half_width, kMinWidthRatio * limbs_[i - 1]->line.half_width);
    return half_width;
  }

  static glm::dvec2 Unit(const glm::dvec2& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec2(0, 1);
  }

  const LimbRegions& regions_;
  const FigureLook& look_;
  const Body& body_;
  std::array<std::optional<Limb>, kStrokeCount> limbs_;
  PictureEvidence evidence_;
};

}  // namespace

PictureEvidence FindLimbEvidence(const LimbRegions& regions, const FigureLook& look) {
  return EvidenceFinder(regions, look).Find();
}

}  // namespace etude
