#include "engine/teaching/moves_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxMoves = 200, kMaxNameBytes = 200;
constexpr double kMaxCoordinateMm = 100'000, kMaxRateHz = 1000;
constexpr Range kTolerances{0.1, 360}, kDegrees{-360, 360};
constexpr double kMillimetres = 1000;

// --- Writing

char LetterOf(const SensedFrame& frame, Role role) {
  if (!frame.body_seen) return '-';
  const TrackingState state = frame[role].state;
  return state == TrackingState::kTracked ? 't' : state == TrackingState::kInferred ? 'i' : 'n';
}

void WriteStream(const SkeletonStream& stream, std::string& text) {
  text += fmt::format("      - rate_hz: {}\n        frames: |\n", stream.rate_hz);
  for (const SensedFrame& frame : stream.frames) {
    text += "          ";
    for (const Role role : AllRoles()) text += LetterOf(frame, role);
    for (const SensedJoint& joint : frame.joints) {
      for (int axis = 0; axis < 3; ++axis) {
        // Round to tenths of a millimetre, whose shortest digits are read back exactly. Zero has no minus sign.
        const double tenths = std::round(10 * kMillimetres * joint.position[axis]);
        text += fmt::format(" {}", tenths == 0 ? 0.0 : tenths / 10);
      }
    }
    text += '\n';
  }
}

void WriteStreams(std::string_view key, const std::vector<SkeletonStream>& streams, std::string& text) {
  text += fmt::format("    {}:{}\n", key, streams.empty() ? " []" : "");
  for (const SkeletonStream& stream : streams) WriteStream(stream, text);
}

std::string Quoted(std::string_view name) {
  std::string quoted = "'";
  for (const char c : name) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

void WriteMove(const TaughtMove& move, std::string& text) {
  text += fmt::format("  - name: {}\n    span_s: {}\n    key_poses:{}\n", Quoted(move.name), move.span_s,
                      move.poses.empty() ? " []" : "");
  for (const TaughtPose& pose : move.poses) {
    std::vector<std::string> targets;
    for (const PoseTarget& target : pose.targets) {
      targets.push_back(fmt::format("{}: {{degrees: {:.1f}, tolerance_deg: {:.1f}}}", FeatureName(target.feature),
                                    target.degrees, target.tolerance_deg));
    }
    text += fmt::format("      - {{{}}}\n", Join(targets));
  }
  WriteStreams("right", move.examples, text);
  WriteStreams("wrong", move.counter_examples, text);
}

// --- Reading

Result<PoseTarget> ReadTarget(const Node::Entry& entry, double tolerance_deg) {
  const Feature* feature = FindFeature(entry.key);
  if (feature == nullptr) {
    std::vector<std::string> names;
    for (const Feature known : AllFeatures()) names.emplace_back(FeatureName(known));
    return Fail(entry.place, "{}", UnknownName("feature", entry.key, names));
  }
  PoseTarget target{.feature = *feature, .degrees = 0, .tolerance_deg = tolerance_deg};
  if (entry.value.kind == Node::Kind::kMapping) {
    Fields fields(entry.value, "a target");
    target.degrees = fields.Number("degrees", 0, kDegrees);
    target.tolerance_deg = fields.Number("tolerance_deg", tolerance_deg, kTolerances);
    RETURN_IF_ERROR(fields.Finish());
  } else {
    ASSIGN_OR_RETURN(target.degrees, AsNumber(entry.value));
  }
  if (target.tolerance_deg > 0) return target;
  return Fail(entry.place, "neither this angle nor its key pose has a tolerance_deg");
}

Result<TaughtPose> ReadPose(const Node& node) {
  if (node.kind != Node::Kind::kMapping)
    return Fail(node.place, "a key pose must be a mapping, found {}", Describe(node));
  double tolerance_deg = 0;
  if (const Node* shared = node.Find("tolerance_deg")) {
    ASSIGN_OR_RETURN(tolerance_deg, AsNumber(*shared));
    if (!(tolerance_deg >= kTolerances.lowest && tolerance_deg <= kTolerances.highest)) {
      return Fail(shared->place, "tolerance_deg is {}; allowed: {} to {}", tolerance_deg, kTolerances.lowest,
                  kTolerances.highest);
    }
  }
  TaughtPose pose;
  for (const Node::Entry& entry : node.entries) {
    if (entry.key == "tolerance_deg") continue;
    ASSIGN_OR_RETURN(pose.targets.emplace_back(), ReadTarget(entry, tolerance_deg));
  }
  if (pose.targets.empty()) return Fail(node.place, "the key pose has no angle; allowed: at least one");
  return pose;
}

/// Reads one line: one letter per joint, then sixty numbers.
Result<SensedFrame> ReadFrame(std::string_view line, const Place& place) {
  SensedFrame frame;
  const std::string_view letters = line.substr(0, line.find(' '));
  if (letters.size() != kRoleCount || letters.find_first_not_of("tin-") != std::string_view::npos) {
    return Fail(place, "found {}; allowed: {} letters (t, i, n or -), followed by {} numbers", Quote(letters),
                kRoleCount, 3 * kRoleCount);
  }
  // The first letter states whether a body is seen.
  line.remove_prefix(letters.size());
  frame.body_seen = letters.front() != '-';
  // Read the state and the position of each joint.
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    SensedJoint& joint = frame.joints[i];
    joint.state = letters[i] == 't'   ? TrackingState::kTracked
                  : letters[i] == 'i' ? TrackingState::kInferred
                                      : TrackingState::kNotTracked;
    for (int axis = 0; axis < 3; ++axis) {
      while (line.starts_with(' ')) line.remove_prefix(1);
      const std::string_view from_here = line;
      const auto value = TakeNumber(line);
      if (!value || !(std::abs(*value) <= kMaxCoordinateMm)) {
        return Fail(place, "found {} for number {} of {}; allowed: millimetres within ±{:g}",
                    Quote(from_here.substr(0, 12)), 3 * i + static_cast<std::size_t>(axis) + 1, 3 * kRoleCount,
                    kMaxCoordinateMm);
      }
      joint.position[axis] = *value / kMillimetres;
    }
  }
  if (line.find_first_not_of(" \r") == std::string_view::npos) return frame;
  return Fail(place, "found more than {} numbers in a line", 3 * kRoleCount);
}

Result<SkeletonStream> ReadStream(const Node& node) {
  Fields fields(node, "a performance");
  SkeletonStream stream;
  stream.rate_hz = fields.Number("rate_hz", kJudgedRateHz, {1, kMaxRateHz});
  const std::string frames = fields.RequiredText("frames");
  RETURN_IF_ERROR(fields.Finish());
  Place place = fields.Raw("frames")->place;
  std::string_view rest = frames;
  while (!rest.empty()) {
    ++place.line;  // the block of frames begins in the line after the key
    ASSIGN_OR_RETURN(stream.frames.emplace_back(), ReadFrame(TakeLine(rest), {place.file, place.line, 0}));
  }
  return stream;
}

Result<std::vector<SkeletonStream>> ReadStreams(const Node* node) {
  std::vector<SkeletonStream> streams;
  if (node == nullptr) return streams;
  if (node->kind != Node::Kind::kSequence)
    return Fail(node->place, "a list of performances, found {}", Describe(*node));
  for (const Node& item : node->items) {
    ASSIGN_OR_RETURN(streams.emplace_back(), ReadStream(item));
  }
  return streams;
}

Result<TaughtMove> ReadMove(const Node& node) {
  Fields fields(node, "a move");
  TaughtMove move;
  move.name = fields.RequiredText("name");
  move.span_s = fields.Number("span_s", move.span_s, {0.1, kMaxSpan});
  const Node *poses = fields.Raw("key_poses"), *right = fields.Raw("right"), *wrong = fields.Raw("wrong");
  RETURN_IF_ERROR(fields.Finish());
  if (move.name.empty() || move.name.size() > kMaxNameBytes) {
    return Fail(node.place, "the name has {} bytes; allowed: 1 to {}", move.name.size(), kMaxNameBytes);
  }
  if (std::ranges::any_of(move.name, [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
    return Fail(node.place, "the name contains a line break or another control character; allowed: other characters");
  }
  if (poses != nullptr) {
    if (poses->kind != Node::Kind::kSequence)
      return Fail(poses->place, "'key_poses' must be a list of key poses, found {}", Describe(*poses));
    for (const Node& pose : poses->items) {
      ASSIGN_OR_RETURN(move.poses.emplace_back(), ReadPose(pose));
    }
  }
  ASSIGN_OR_RETURN(move.examples, ReadStreams(right));
  ASSIGN_OR_RETURN(move.counter_examples, ReadStreams(wrong));
  return move;
}

}  // namespace

std::string WriteMoves(const std::vector<TaughtMove>& moves) {
  std::string text = "moves:\n";
  for (const TaughtMove& move : moves) WriteMove(move, text);
  return text;
}

Result<std::vector<TaughtMove>> ReadMoves(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const Node root, ParseYaml(text, file, kMaxFileBytes));
  Fields fields(root, "a moves file");
  const Node* list = fields.Raw("moves");
  RETURN_IF_ERROR(fields.Finish());
  if (list == nullptr || list->kind != Node::Kind::kSequence || list->items.empty()) {
    return Fail(list == nullptr ? root.place : list->place, "'moves' must be a list of at least one move");
  }
  if (list->items.size() > kMaxMoves)
    return Fail(list->place, "found {} moves; allowed: at most {}", list->items.size(), kMaxMoves);
  std::vector<TaughtMove> moves;
  for (const Node& item : list->items) {
    ASSIGN_OR_RETURN(TaughtMove move, ReadMove(item));
    if (FindByName(moves, move.name)) return Fail(item.place, "a second move called {}", Quote(move.name));
    moves.push_back(std::move(move));
  }
  return moves;
}

}  // namespace etude
