#include "engine/retargeting/opensim_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/formats/row_clock.h"
#include "engine/formats/text_scanner.h"
#include "engine/kinematics/body_tree.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/rig.h"

namespace etude {
namespace {

using enum Role;

/// An angle of `MakeBodyTree`, whose range limits an angle of the file. `is_reversed`: the tree's angle has the
/// opposite sign.
struct TreeAngle {
  BodyTreeJoint joint;
  int axis = 0;
  bool is_reversed = false;
};

/// An angle of a part: the angle's name without the side, and its range on the right side.
struct PartAngle {
  std::string_view name;
  std::optional<TreeAngle> range = {};
};

/// The part that ends at `end`. Only right parts and parts of the middle are listed; left parts mirror the right parts.
struct Part {
  Role end;
  std::array<PartAngle, 3> angles;  ///< the angles about Z, X and Y
  double z_sign = 1;                ///< −1 for knees, which bend backwards
};

// Parents come before children, in the order of AllRoles.
const std::array<Part, 12> kParts = {{
    {kHipCentre, {{{"pelvis_tilt"}, {"pelvis_list"}, {"pelvis_rotation"}}}},
    {kSpine, {{{"abdomen_extension"}, {"abdomen_bending"}, {"abdomen_rotation"}}}},
    {kShoulderCentre,
     {{{"lumbar_extension", TreeAngle{kTreeNavel, 0}},
       {"lumbar_bending", TreeAngle{kTreeNavel, 1}},
       {"lumbar_rotation", TreeAngle{kTreeNavel, 2}}}}},
    {kHead,
     {{{"neck_extension", TreeAngle{kTreeNeck, 0}},
       {"neck_bending", TreeAngle{kTreeNeck, 1}},
       {"neck_rotation", TreeAngle{kTreeNeck, 2}}}}},
    {kRightShoulder, {{{"clavicle_flex"}, {"clavicle_add"}, {"clavicle_rot"}}}},
    {kRightElbow,
     {{{"arm_flex", TreeAngle{kTreeRightShoulder, 0}},
       {"arm_add", TreeAngle{kTreeRightShoulder, 1, true}},
       {"arm_rot", TreeAngle{kTreeRightShoulder, 2, true}}}}},
    {kRightWrist, {{{"elbow_flex", TreeAngle{kTreeRightElbow, 0}}, {"elbow_add"}, {"pro_sup"}}}},
    {kRightHand, {{{"wrist_flex", TreeAngle{kTreeRightWrist, 0}}, {"wrist_dev"}, {"wrist_rot"}}}},
    {kRightHip, {{{"girdle_flex"}, {"girdle_add"}, {"girdle_rot"}}}},
    {kRightKnee,
     {{{"hip_flexion", TreeAngle{kTreeRightHip, 0}},
       {"hip_adduction", TreeAngle{kTreeRightHip, 1, true}},
       {"hip_rotation", TreeAngle{kTreeRightHip, 2, true}}}}},
    {kRightAnkle, {{{"knee_angle", TreeAngle{kTreeRightKnee, 0, true}}, {"knee_adduction"}, {"knee_rotation"}}}, -1},
    {kRightFoot,
     {{{"ankle_angle", TreeAngle{kTreeRightAnkle, 0}},
       {"ankle_inversion", TreeAngle{kTreeRightAnkle, 1, true}},
       {"ankle_rotation"}}}},
}};

/// A part of the left side, the right side or the middle, as it is written to the file.
struct WrittenPart {
  Role end;
  std::array<std::string, 3> names;
  std::array<std::optional<AngleRange>, 3> limits;  ///< radians
  glm::dvec3 signs{1};                              ///< signs of the rotations about Z, X and Y
};

std::optional<AngleRange> RangeOf(const PartAngle& angle, const KinematicTree& tree) {
  if (!angle.range) return std::nullopt;
  const AngleRange range = tree.limits[tree.joints[angle.range->joint].first_dof + angle.range->axis];
  return angle.range->is_reversed ? AngleRange{-range.upper, -range.lower} : range;
}

std::vector<WrittenPart> WrittenParts() {
  const KinematicTree tree = MakeBodyTree({});
  std::vector<WrittenPart> parts;
  for (const Role role : AllRoles()) {
    const auto is_it = [&](const Part& one) { return one.end == role || Mirrored(one.end) == role; };
    const Part& part = *std::ranges::find_if(kParts, is_it);
    const bool is_left = part.end != role, is_paired = Mirrored(role) != role;
    WrittenPart written{
        .end = role, .names = {}, .limits = {}, .signs = {part.z_sign, is_left ? -1 : 1, is_left ? -1 : 1}};
    for (std::size_t i = 0; i < 3; ++i) {
      written.names[i] = std::string(part.angles[i].name) + (is_left ? "_l" : is_paired ? "_r" : "");
      written.limits[i] = RangeOf(part.angles[i], tree);
    }
    parts.push_back(std::move(written));
  }
  return parts;
}

/// Converts from Etude's axes (X to the left, Y up, Z forward) to OpenSim's (X forward, Y up, Z to the right).
glm::dvec3 InOpenSim(const glm::dvec3& v) { return {v.z, v.y, -v.x}; }

glm::dmat3 InOpenSim(const glm::dmat3& turn) {
  // Compute column j: OpenSim's axis j, converted to our axes, rotated by `turn`, and converted back.
  return {InOpenSim(turn * glm::dvec3(0, 0, 1)), InOpenSim(turn * glm::dvec3(0, 1, 0)),
          InOpenSim(turn * glm::dvec3(-1, 0, 0))};
}

double Unwrapped(double angle, double near) { return angle - 2 * kPi * std::round((angle - near) / (2 * kPi)); }

/// Returns the angles a, b, c of R = Rz(a) Rx(b) Ry(c). Among all such triples, takes the triple nearest to `before`.
glm::dvec3 TurnsOf(const glm::dmat3& R, const glm::dvec3& before) {
  const auto at = [&](int row, int column) { return R[column][row]; };
  constexpr double kLocked = 1e-9;
  const double b = std::asin(std::clamp(at(2, 1), -1.0, 1.0));
  double a = std::atan2(-at(0, 1), at(1, 1)), c = std::atan2(-at(2, 0), at(2, 2));
  if (std::hypot(at(0, 1), at(1, 1)) < kLocked) {  // gimbal lock: only the sum or difference of a and c is determined
    c = before.z;
    a = std::atan2(at(1, 0), at(0, 0)) - (b > 0 ? c : -c);
  }
  const auto near = [&](double x, double y, double z) {
    return glm::dvec3(Unwrapped(x, before.x), Unwrapped(y, before.y), Unwrapped(z, before.z));
  };
  const glm::dvec3 one = near(a, b, c), other = near(a + kPi, kPi - b, c + kPi);
  return glm::distance(one, before) <= glm::distance(other, before) ? one : other;
}

/// Returns the world rotation of each part relative to the rest pose, by the role at the part's end.
std::array<glm::dmat3, kRoleCount> PartTurns(const BodyPose& pose, const BodyPose& rest, const Clip& rig,
                                             const LocalPose& frame) {
  std::vector<GlobalTransform> joints;
  ComputeGlobals(rig.skeleton, frame, joints);
  std::array<glm::dmat3, kRoleCount> turns;
  turns[Index(kHipCentre)] = joints[Index(kHipCentre)].axes;
  for (const Bone& bone : AllBones()) {
    // A limb turns with the joint in which it begins. If several limbs begin in one joint, each limb takes the shortest
    // rotation from the joint's orientation to the limb's own direction.
    const glm::dmat3& axes = joints[Index(bone.parent)].axes;
    const glm::dvec3 carried = axes * (rest[bone.child] - rest[bone.parent]);
    turns[Index(bone.child)] = glm::mat3_cast(ShortestTurn(carried, pose[bone.child] - pose[bone.parent])) * axes;
  }
  return turns;
}

std::string HeaderOf(const BodyMotion& motion, const std::vector<WrittenPart>& parts, const BodyPose& rest,
                     std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, '_');
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "Coordinates\nversion=1\nnRows={}\nnColumns={}\ninDegrees=yes\n\n", motion.poses.size(),
                 1 + 3 + 3 * parts.size());
  // Write one line for each part, then one for each limited angle, then the names of the columns.
  fmt::format_to(out, "Motion {}, angles of the model below; metres, X forward, Y up, Z to the right\n", name);
  for (const WrittenPart& part : parts) {
    const auto parent = ParentOf(part.end);
    const glm::dvec3 bone = parent ? InOpenSim(rest[part.end] - rest[*parent]) : glm::dvec3(0);
    fmt::format_to(out, "part {} after {} bone {:.9g} {:.9g} {:.9g} turns", RoleName(part.end),
                   parent ? RoleName(*parent) : "ground", bone.x, bone.y, bone.z);
    for (int i = 0; i < 3; ++i) fmt::format_to(out, " {}{} {}", part.signs[i] < 0 ? '-' : '+', "ZXY"[i], part.names[i]);
    text += '\n';
  }
  for (const WrittenPart& part : parts) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!part.limits[i]) continue;
      fmt::format_to(out, "limit {} {:g} {:g}\n", part.names[i], Degrees(part.limits[i]->lower),
                     Degrees(part.limits[i]->upper));
    }
  }
  text += "\nendheader\ntime";
  for (const WrittenPart& part : parts) {
    for (const std::string& angle : part.names) text += "\t" + angle;
    if (part.end == kHipCentre) text += "\tpelvis_tx\tpelvis_ty\tpelvis_tz";
  }
  return text + "\n";
}

/// A part as read from the file, with the columns of its angles.
struct ReadPart {
  Role end;
  std::optional<Role> after;  ///< the role at the parent part's end; nullopt: the ground
  glm::dvec3 bone;            ///< vector from the part's beginning to its end, in OpenSim's axes, metres
  std::array<std::string, 3> names;
  std::array<glm::dvec3, 3> axes;  ///< the signed axes of the three rotations
  std::array<std::size_t, 3> columns = {};
};

/// Reads the rest of a line that begins with "part". `read` holds the parts of the lines above.
Result<ReadPart> ReadPartLine(TextScanner& scanner, const std::vector<ReadPart>& read) {
  ReadPart part{};
  // Read the name of the part and of its parent.
  const Token name = scanner.NextInLine(), after_word = scanner.NextInLine(), after = scanner.NextInLine();
  const auto end = FindRole(name.text);
  const auto ends_at = [&](Role role) { return std::ranges::find(read, role, &ReadPart::end) != read.end(); };
  if (!end || ends_at(*end)) {
    return Fail(scanner.At(name), "found the body part {}; allowed: each of the twenty roles once", Quote(name.text));
  }
  part.end = *end;
  part.after = FindRole(after.text);
  const bool is_first = read.empty() && after.text == "ground";
  if (after_word.text != "after" || !(is_first || (part.after && ends_at(*part.after)))) {
    return Fail(scanner.At(after_word),
                "found {}; allowed: 'after ground' for the first body part, otherwise 'after' and a body part from a "
                "line above",
                Quote(fmt::format("{} {}", after_word.text, after.text)));
  }
  // Read the bone, then three angles with their axes.
  const Token bone = scanner.NextInLine();
  if (bone.text != "bone") return Fail(scanner.At(bone), "found {}; allowed: 'bone' X Y Z", Quote(bone.text));
  for (int i = 0; i < 3; ++i) {
    ASSIGN_OR_RETURN(part.bone[i], scanner.Number(scanner.NextInLine(), "a bone's end"));
  }
  const Token turns = scanner.NextInLine();
  if (turns.text != "turns")
    return Fail(scanner.At(turns), "found {}; allowed: 'turns', followed by three angles", Quote(turns.text));
  for (std::size_t i = 0; i < 3; ++i) {
    const Token axis = scanner.NextInLine(), angle = scanner.NextInLine();
    const bool has_axis = axis.text.size() == 2 && (axis.text[0] == '+' || axis.text[0] == '-') &&
                          axis.text[1] >= 'X' && axis.text[1] <= 'Z';
    if (!has_axis || angle.text.empty()) {
      return Fail(
          scanner.At(axis),
          "found the axis and angle {} {}; allowed: +X, -X, +Y, -Y, +Z or -Z, followed by the name of the angle",
          Quote(axis.text), Quote(angle.text));
    }
    part.axes[i][axis.text[1] - 'X'] = axis.text[0] == '-' ? -1 : 1;
    part.names[i] = angle.text;
  }
  return part;
}

/// The model and the rows of a .mot file.
struct AngleTable {
  std::vector<ReadPart> parts;
  double radians = Radians(1);            ///< radians per unit of angles
  bool has_unit = false;                  ///< true if the header states the unit of angles
  std::array<std::size_t, 3> place = {};  ///< columns of the pelvis's translation
  std::vector<std::vector<double>> rows;  ///< the first column is the time, seconds
};

Result<void> FindColumns(TextScanner& scanner, AngleTable& table, std::size_t& count) {
  const Token time = scanner.Next();
  if (time.text != "time")
    return Fail(scanner.At(time), "found {}; allowed: 'time', followed by the names of the angles", Quote(time.text));
  std::vector<std::string> names{"time"};
  for (Token name = scanner.NextInLine(); !name.text.empty(); name = scanner.NextInLine()) {
    names.emplace_back(name.text);
  }
  count = names.size();
  const auto find = [&](const std::string& name, std::size_t& column) -> Result<void> {
    column = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (column == names.size())
      return Fail(scanner.At(time), "the model needs the column {}, but the file does not have it", Quote(name));
    if (std::ranges::count(names, name) > 1)
      return Fail(scanner.At(time), "the column {} is in the file twice; allowed: once", Quote(name));
    return {};
  };
  for (ReadPart& part : table.parts) {
    for (std::size_t i = 0; i < 3; ++i) RETURN_IF_ERROR(find(part.names[i], part.columns[i]));
  }
  for (std::size_t i = 0; i < 3; ++i) RETURN_IF_ERROR(find(fmt::format("pelvis_t{}", "xyz"[i]), table.place[i]));
  return {};
}

/// Reads the unit of angles from a line of the header, given without blanks; other lines are skipped.
Result<void> ReadUnit(std::string line, const Place& place, AngleTable& table) {
  line = InLowerCase(std::move(line));
  if (!line.starts_with("indegrees")) return {};
  const bool is_degrees = line == "indegrees=yes";
  if (!is_degrees && line != "indegrees=no") {
    return Fail(place, "found {}; allowed: inDegrees=yes or inDegrees=no", Quote(line));
  }
  table.radians = is_degrees ? Radians(1) : 1;
  table.has_unit = true;
  return {};
}

/// Compares the size of the angles with their unit. Without a stated unit, sets the unit by the angles. `note` receives
/// a text for users. Angles beyond two turns are not radians. If no angle is beyond one turn in radians, all angles as
/// degrees would be below 6.3, so the body would hardly leave its rest pose.
Result<void> CheckUnit(AngleTable& table, const std::string& file, std::string& note) {
  constexpr double kMaxRadians = 4 * kPi, kMinMoved = 0.5, kUsualRadians = 2 * kPi;
  double largest = 0;
  std::string name;
  for (const ReadPart& part : table.parts) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::vector<double>& row : table.rows) {
        if (std::abs(row[part.columns[i]]) <= std::abs(largest)) continue;
        largest = row[part.columns[i]];
        name = part.names[i];
      }
    }
  }
  const bool are_small = std::abs(largest) > kMinMoved && std::abs(largest) <= kUsualRadians;
  if (!table.has_unit) {
    if (are_small) table.radians = 1;
    note = fmt::format("the file has no line inDegrees, so Etude reads the angles as {} (the largest is {:.3g})",
                       are_small ? "radians" : "degrees", largest);
    return {};
  }
  if (table.radians == 1 && std::abs(largest) > kMaxRadians) {
    return Fail({file}, "the file states inDegrees=no, but {} is {:.4g}; allowed: at most 12.57 radians (4π)", name,
                largest);
  }
  if (table.radians != 1 && are_small) {
    note = fmt::format(
        "the file states inDegrees=yes, but the largest angle is only {:.3g} ({}); are the angles in radians?", largest,
        name);
  }
  return {};
}

Result<AngleTable> ReadAngleTable(std::string_view bytes, const std::string& file) {
  TextScanner scanner(bytes, file);
  // Read the header, then the columns, then the rows.
  AngleTable table;
  while (true) {
    const Token first = scanner.Next();
    if (first.text.empty()) return Fail(scanner.At(first), "no endheader");
    if (first.text == "endheader") break;
    if (first.text == "part") {
      ASSIGN_OR_RETURN(auto part, ReadPartLine(scanner, table.parts));
      table.parts.push_back(std::move(part));
    }
    std::string line(first.text);
    for (Token word = scanner.NextInLine(); !word.text.empty(); word = scanner.NextInLine()) line += word.text;
    RETURN_IF_ERROR(ReadUnit(std::move(line), scanner.At(first), table));
  }
  if (table.parts.size() != kRoleCount) {
    return Fail({file}, "the model has {} body parts; allowed: {}, one for each role", table.parts.size(), kRoleCount);
  }
  std::size_t columns = 0;
  RETURN_IF_ERROR(FindColumns(scanner, table, columns));
  for (Token word = scanner.Next(); !word.text.empty(); word = scanner.Next()) {
    std::vector<double>& row = table.rows.emplace_back();
    const Token begin = word;
    for (; !word.text.empty() && row.size() <= columns; word = scanner.NextInLine()) {
      ASSIGN_OR_RETURN(const double number, scanner.Number(word, "an angle or a position"));
      row.push_back(number);
    }
    if (row.size() != columns)
      return Fail(scanner.At(begin), "this row has {} numbers, but the header has {} names", row.size(), columns);
  }
  if (table.rows.empty()) return Fail({file}, "no rows of angles");
  return table;
}

/// Fails unless the mean rate of the rows is 0.1 to 10,000 Hz.
Result<void> CheckTimes(const std::vector<double>& times, const std::string& file) {
  if (times.size() < 2) return {};
  constexpr double kMinRate_hz = 0.1, kMaxRate_hz = 10'000;
  const double span = times.back() - times.front();
  const double rate = span > 0 ? static_cast<double>(times.size() - 1) / span : 0;
  if (rate >= kMinRate_hz && rate <= kMaxRate_hz) return {};
  return Fail({file}, "found {} rows in {:g} s; allowed: {:g} to {:g} rows per second", times.size(), span, kMinRate_hz,
              kMaxRate_hz);
}

/// Converts from OpenSim's axes to Etude's; the inverse of InOpenSim.
glm::dvec3 FromOpenSim(const glm::dvec3& v) { return {-v.z, v.y, v.x}; }

}  // namespace

bool HasModelOfAngles(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, bytes.find("\nendheader"));
  return head.size() < bytes.size() && head.find("\npart ") != std::string_view::npos;
}

Result<BodyMotion> ReadOpenSimMotion(std::string_view bytes, const std::string& file, std::string* note,
                                     double* start_s) {
  constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
  if (bytes.size() > kMaxBytes) return Fail({file}, "found {} bytes; allowed: at most {}", bytes.size(), kMaxBytes);
  ASSIGN_OR_RETURN(AngleTable table, ReadAngleTable(bytes, file));
  std::string unit;
  RETURN_IF_ERROR(CheckUnit(table, file, unit));
  std::vector<double> times;
  for (const std::vector<double>& row : table.rows) times.push_back(row.front());
  RETURN_IF_ERROR(CheckTimes(times, file));
  BodyMotion motion{.rate_hz = kJudgedRateHz, .poses = std::vector<BodyPose>(table.rows.size())};
  // Compute the forward kinematics of every row.
  for (std::size_t f = 0; f < table.rows.size(); ++f) {
    const std::vector<double>& row = table.rows[f];
    const glm::dvec3 ground(row[table.place[0]], row[table.place[1]], row[table.place[2]]);
    std::array<glm::dmat3, kRoleCount> turns;
    std::array<glm::dvec3, kRoleCount> ends;
    for (const ReadPart& part : table.parts) {
      glm::dmat3 R = part.after ? turns[Index(*part.after)] : glm::dmat3(1);
      for (std::size_t i = 0; i < 3; ++i) {
        R = R * glm::mat3_cast(glm::angleAxis(table.radians * row[part.columns[i]], part.axes[i]));
      }
      turns[Index(part.end)] = R;
      ends[Index(part.end)] = (part.after ? ends[Index(*part.after)] : ground) + R * part.bone;
      motion.poses[f][part.end] = FromOpenSim(ends[Index(part.end)]);
    }
  }
  std::string changed;
  double start = 0;
  ASSIGN_OR_RETURN(motion, LayOnClock(std::move(motion), times, file, changed, start));
  if (start_s != nullptr) *start_s = start;
  for (const std::string& said : {unit, changed}) {
    if (note != nullptr && !said.empty()) *note += (note->empty() ? "" : "; ") + said;
  }
  return motion;
}

std::string WriteOpenSimMotion(const BodyMotion& motion, const BodyPose& rest, std::string name, double start_s) {
  const std::vector<WrittenPart> parts = WrittenParts();
  const Clip rig = RigClip(motion, rest, name);
  std::string text = HeaderOf(motion, parts, rest, std::move(name));
  const auto out = std::back_inserter(text);
  std::array<glm::dvec3, kRoleCount> before{};
  // Write the angles between each part and its parent.
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    const BodyPose& pose = motion.poses[f];
    const auto turns = PartTurns(pose, rest, rig, rig.frames[f]);
    fmt::format_to(out, "{:.6f}", start_s + static_cast<double>(f) / motion.rate_hz);
    for (const WrittenPart& part : parts) {
      const auto parent = ParentOf(part.end);
      const glm::dmat3 above = parent ? turns[Index(*parent)] : glm::dmat3(1);
      glm::dvec3& angles = before[Index(part.end)];
      angles = TurnsOf(InOpenSim(glm::transpose(above) * turns[Index(part.end)]), angles);
      for (int i = 0; i < 3; ++i) fmt::format_to(out, "\t{:.6f}", Degrees(part.signs[i] * angles[i]));
      if (parent) continue;
      const glm::dvec3 place = InOpenSim(pose[part.end]);
      fmt::format_to(out, "\t{:.6f}\t{:.6f}\t{:.6f}", place.x, place.y, place.z);
    }
    text += '\n';
  }
  return text;
}

}  // namespace etude
