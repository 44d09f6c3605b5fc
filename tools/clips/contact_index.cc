#include "tools/clips/contact_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "io/drawing/escape.h"
#include "io/drawing/panel.h"

namespace etude {
namespace {

constexpr double kPictureWidth = 960, kLabelWidth = 70, kRightEdge = 20, kPanelHeight = 90, kBarHeight = 12,
                 kBetween = 22, kTitleHeight = 44;
constexpr double kCm = 100;
constexpr std::array kSides = {std::pair("left foot", Role::kLeftFoot), std::pair("right foot", Role::kRightFoot)};

/// A curve over the clip, with the limit that the curve must not exceed while the foot is in contact with the ground.
struct CurvePanel {
  std::string label, unit;
  std::vector<double> values;
  double limit = 0;
};

class ContactPicture {
 public:
  explicit ContactPicture(const BodyMotion& motion)
      : rate_hz_(motion.rate_hz),
        frames_{.low = 0,
                .high = static_cast<double>(std::max<std::size_t>(motion.poses.size(), 2) - 1),
                .from = kLabelWidth,
                .to = kPictureWidth - kRightEdge} {}

  void Add(const CurvePanel& panel) {
    // Cut the axis at four times the limit. Larger values need not be distinguished, and the range near the limit stays
    // readable.
    const double top = std::clamp(*std::ranges::max_element(panel.values), 1.5 * panel.limit, 4 * panel.limit);
    const Axis axis{.low = 0, .high = top, .from = y_ + kPanelHeight, .to = y_};
    body_ += fmt::format(
        R"(<line x1="{}" x2="{}" y1="{:.1f}" y2="{:.1f}" class="threshold"/><text x="{}" y="{:.1f}" class="tick">{:g}</text>)"
        "\n",
        kLabelWidth, kPictureWidth - kRightEdge, axis.At(panel.limit), axis.At(panel.limit), kLabelWidth - 6,
        axis.At(panel.limit) + 4, panel.limit);
    std::string points;
    for (std::size_t f = 0; f < panel.values.size(); ++f) {
      points += fmt::format("{:.1f},{:.1f} ", frames_.At(static_cast<double>(f)), axis.At(panel.values[f]));
    }
    body_ += fmt::format("<polyline points=\"{}\"/>\n<text x=\"{}\" y=\"{:.1f}\">{}, {}</text>\n", points, kLabelWidth,
                         y_ - 4, panel.label, panel.unit);
    y_ += kPanelHeight + kBetween;
  }

  void AddBars(const std::vector<bool>& stands) {
    y_ -= kBetween - 4;
    for (std::size_t first = 0; first < stands.size();) {
      std::size_t end = first;
      while (end < stands.size() && stands[end] == stands[first]) ++end;
      if (stands[first]) {
        const double x = frames_.At(static_cast<double>(first)),
                     to = frames_.At(static_cast<double>(std::min(end, stands.size() - 1)));
        body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\"/>\n", x, y_,
                             std::max(to - x, 1.0), kBarHeight);
      }
      first = end;
    }
    y_ += kBarHeight + kBetween + 8;
  }

  std::string Svg(const std::string& title) {
    const double seconds = frames_.high / rate_hz_, step = std::max(1.0, std::ceil(seconds / 12));
    for (double second = 0; second <= seconds; second += step) {
      body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"time\">{:g} s</text>\n",
                           frames_.At(second * rate_hz_), y_, second);
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1:.0f}\" viewBox=\"0 0 {0} {1:.0f}\">\n"
        "<style>text{{font:12px sans-serif;fill:#222}}.tick{{text-anchor:end}}.time{{text-anchor:middle}}"
        "polyline{{fill:none;stroke:#316f93}}.threshold{{stroke:#9c5201;stroke-dasharray:4 "
        "3}}rect{{fill:#1ea194}}</style>\n"
        "<rect width=\"100%\" height=\"100%\" style=\"fill:#fff\"/>\n<text x=\"{2}\" y=\"20\">{3}</text>\n{4}</svg>\n",
        kPictureWidth, y_ + 12, kLabelWidth, EscapeMarkup(title), body_);
  }

 private:
  const double rate_hz_;
  const Axis frames_;
  double y_ = kTitleHeight;
  std::string body_;
};

}  // namespace

std::string ContactIndexSvg(const std::string& name, const BodyMotion& motion) {
  // Find the contacts and the velocities of all joints.
  const FootContacts contacts = FindFootContacts(motion.poses, motion.rate_hz);
  const std::vector<BodyPose> velocities = JointVelocities(motion.poses, motion.rate_hz);
  ContactPicture picture(motion);
  std::string title = name;
  // For each foot, draw height and speed as curves and contacts as bars, and collect the share of contact time for the
  // title.
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    const auto& [label, toes] = kSides[side];
    CurvePanel height{.label = fmt::format("{}: height of the toe tip above the lowest joint", label),
                      .unit = "cm",
                      .values = {},
                      .limit = kCm * kFootRules.lowest};
    CurvePanel speed{
        .label = fmt::format("{}: speed", label), .unit = "cm/s", .values = {}, .limit = kCm * kFootRules.rest_speed};
    for (std::size_t f = 0; f < motion.poses.size(); ++f) {
      const BodyPose& pose = motion.poses[f];
      const double lowest = std::ranges::min(pose.joints, {}, &glm::dvec3::y).y;
      height.values.push_back(kCm * (pose[toes].y - lowest));
      speed.values.push_back(kCm * glm::length(velocities[f][toes]));
    }
    picture.Add(height);
    picture.Add(speed);
    picture.AddBars(contacts[side]);
    const auto standing = static_cast<double>(std::ranges::count(contacts[side], true));
    title += fmt::format("{} {} is on the floor for {:.0f} % of the time", side == 0 ? ":" : ",", label,
                         100 * standing / static_cast<double>(motion.poses.size()));
  }
  return picture.Svg(title);
}

}  // namespace etude
