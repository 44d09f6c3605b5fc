#include "tools/clips/role_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/names.h"
#include "io/drawing/look.h"
#include "tools/clips/contact_sheet.h"

namespace etude {
namespace {

constexpr int kSheetWidth = 1200, kMinHeight = 760;
constexpr double kEdge = 18, kColumn = 360, kLine = 18, kFoot = 56, kTop = 44;
constexpr double kLabelSize = 13;
constexpr Paint kBone{0.45, 0.49, 0.52, 1}, kLeader{0.30, 0.33, 0.36, 1};

/// A joint in the picture and its label.
struct SheetJoint {
  glm::dvec2 at{0};  ///< pixels
  std::string words;
  Paint paint = kSoftInk;
  bool plays = false;
};

std::vector<glm::dvec3> PositionsOf(const Clip& clip) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames.empty() ? RestPose(clip.skeleton) : clip.frames.front(), globals);
  std::vector<glm::dvec3> positions;
  for (const GlobalTransform& joint : globals) positions.push_back(joint.position);
  return positions;
}

/// Returns the directions that point right and up in the picture. Up is Y or Z: the axis along which the body extends
/// further.
std::pair<glm::dvec3, glm::dvec3> ViewOf(const std::vector<glm::dvec3>& positions,
                                         const std::array<RoleOnSheet, kRoleCount>& roles) {
  glm::dvec3 low = positions.front(), high = low;
  for (const glm::dvec3& position : positions) low = glm::min(low, position), high = glm::max(high, position);
  const glm::dvec3 size = high - low;
  const bool is_z_up = size.z > size.y;
  const glm::dvec3 up = is_z_up ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  for (const auto& [left, right] :
       {std::pair{Role::kLeftShoulder, Role::kRightShoulder}, {Role::kLeftHip, Role::kRightHip}}) {
    const int a = roles[Index(left)].joint, b = roles[Index(right)].joint;
    if (a < 0 || b < 0) continue;
    const glm::dvec3 across = positions[a] - positions[b], level = across - glm::dot(across, up) * up;
    if (glm::length(level) > 0.5 * glm::length(across)) return {glm::normalize(level), up};
  }
  const double depth = is_z_up ? size.y : size.z;
  if (size.x >= depth) return {glm::dvec3(1, 0, 0), up};
  return {is_z_up ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), up};
}

void Label(const std::array<RoleOnSheet, kRoleCount>& roles, std::vector<SheetJoint>& joints) {
  using By = RoleOnSheet::By;
  for (const Role role : AllRoles()) {
    const auto& [joint, by] = roles[Index(role)];
    if (joint < 0) continue;
    SheetJoint& shown = joints[joint];
    const bool is_sure = by == By::kName || by == By::kComposed;
    shown.words += fmt::format("{} {}{}", shown.plays ? "," : "  =", RoleName(role),
                               by == By::kComposed   ? " (fixed to it)"
                               : by == By::kAnatomy  ? " (by shape)"
                               : by == By::kProposed ? " ?"
                                                     : "");
    shown.paint = is_sure ? kAccent : kWarm;
    shown.plays = true;
  }
}

/// Draws the labels of one side below each other. Each label is placed as near to the height of the labelled joint as
/// the other labels allow.
void DrawColumn(Canvas& canvas, std::vector<const SheetJoint*> joints, bool is_left) {
  std::ranges::stable_sort(joints, {}, [](const SheetJoint* joint) { return joint->at.y; });
  const double bottom = canvas.height() - kFoot;
  double y = kTop;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const SheetJoint& joint = *joints[i];
    // Leave space for the labels that follow.
    const double last = bottom - kLine * static_cast<double>(joints.size() - i);
    y = std::clamp(joint.at.y, std::min(y, last), last);
    const double width = std::min(canvas.TextWidth(joint.words, kLabelSize, joint.plays), kColumn);
    const double x = is_left ? kEdge + kColumn - width : canvas.width() - kEdge - kColumn;
    const double from = is_left ? kEdge + kColumn + 6 : x - 6;
    canvas.DrawLine({from, y}, joint.at, 1, kLeader);
    canvas.DrawText({x, y + 4}, joint.words, kLabelSize, joint.paint, kColumn, joint.plays);
    y += kLine;
  }
}

std::string MissingRoles(const std::array<RoleOnSheet, kRoleCount>& roles) {
  std::vector<std::string> missing;
  for (const Role role : AllRoles()) {
    if (roles[Index(role)].joint < 0) missing.emplace_back(RoleName(role));
  }
  return missing.empty() ? "every role has a joint" : "roles without a joint: " + Join(missing);
}

}  // namespace

Result<std::string> DrawRoleSheet(const Clip& clip, const std::array<RoleOnSheet, kRoleCount>& roles) {
  const std::vector<glm::dvec3> positions = PositionsOf(clip);
  const auto [right, up] = ViewOf(positions, roles);
  // Project the joints onto the plane of the picture.
  std::vector<SheetJoint> joints(positions.size());
  glm::dvec2 low(INFINITY), high(-INFINITY);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    joints[i] = {.at = {glm::dot(right, positions[i]), -glm::dot(up, positions[i])},
                 .words = Quote(clip.skeleton.joints[i].name)};
    low = glm::min(low, joints[i].at), high = glm::max(high, joints[i].at);
  }
  const double size = std::max(high.x - low.x, high.y - low.y);
  if (!std::isfinite(size) || size <= 0)
    return Fail({}, "all joints of the skeleton are at the same position, so the skeleton cannot be drawn");
  // Label the joints with names and roles, and put each label on the joint's side of the picture.
  Label(roles, joints);

  const auto is_labelled = [&](std::size_t i) { return joints[i].plays || !clip.skeleton.joints[i].is_end_site; };
  std::array<std::vector<const SheetJoint*>, 2> columns;
  const double middle = (low.x + high.x) / 2;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (is_labelled(i)) columns[joints[i].at.x < middle ? 0 : 1].push_back(&joints[i]);
  }
  const double lines = static_cast<double>(std::max(columns[0].size(), columns[1].size()));
  const double height = std::max<double>(kMinHeight, kTop + kLine * (lines + 1) + kFoot);
  if (height > kMaxSheetSide) return Fail({}, "found {} joints, which are too many for one picture", joints.size());

  Canvas canvas(kSheetWidth, static_cast<int>(height));
  canvas.FillBox({0, 0, kSheetWidth, height}, kBackdrop);
  // Scale the skeleton into the space between the labels.
  const double room_x = kSheetWidth - 2 * (kEdge + kColumn + 30), room_y = kMinHeight - kTop - kFoot - 40;
  const double scale =
      std::min(room_x / std::max(high.x - low.x, 1e-9 * size), room_y / std::max(high.y - low.y, 1e-9 * size));
  const glm::dvec2 centre(kSheetWidth / 2.0, (kTop + height - kFoot) / 2);
  for (SheetJoint& joint : joints) joint.at = centre + scale * (joint.at - (low + high) / 2.0);

  // Draw bones, labels and joints.
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const int parent = clip.skeleton.joints[i].parent;
    if (parent >= 0) canvas.DrawLine(joints[parent].at, joints[i].at, 4, kBone);
  }
  DrawColumn(canvas, columns[0], true);
  DrawColumn(canvas, columns[1], false);
  for (const SheetJoint& joint : joints) canvas.DrawDot(joint.at, joint.plays ? 5 : 3, joint.paint);
  // Draw the title, the missing roles and the legend of colours.
  canvas.DrawText({kEdge, 26}, clip.name, 17, kInk, kSheetWidth - 2 * kEdge, true);
  canvas.DrawText({kEdge, height - 32}, MissingRoles(roles), kLabelSize, kInk, kSheetWidth - 2 * kEdge, true);
  canvas.DrawText({kEdge, height - 12},
                  "blue: role found from the name of the joint or its parent; orange: role found from the skeleton's "
                  "shape; white: no role",
                  kLabelSize, kSoftInk, kSheetWidth - 2 * kEdge);
  return canvas.Png();
}

}  // namespace etude
