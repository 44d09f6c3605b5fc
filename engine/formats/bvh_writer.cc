#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "engine/base/angles.h"
#include "engine/formats/bvh.h"
#include "engine/formats/unique_names.h"
#include "engine/motion/edit.h"

namespace etude {
namespace {

/// Euler angles in radians with R = Rz(z) Rx(x) Ry(y).
struct EulerZxy {
  double z, x, y;
};

EulerZxy ToEulerZxy(const glm::dquat& rotation) {
  const glm::dmat3 columns = glm::mat3_cast(rotation);
  const auto r = [&](int row, int column) { return columns[column][row]; };
  const double cos_x = std::hypot(r(2, 0), r(2, 2));
  const double x = std::atan2(r(2, 1), cos_x);
  // At x = ±90° only z ± y is determined, so y is set to 0.
  constexpr double kLocked = 1e-9;
  if (cos_x < kLocked) return {std::atan2(r(1, 0), r(0, 0)), x, 0};
  return {std::atan2(-r(0, 1), r(1, 1)), x, std::atan2(-r(2, 0), r(2, 2))};
}

/// Rounds to the file's six decimals and returns millionths; never returns minus zero.
double Millionths(double value) { return std::round(value * 1e6) + 0.0; }
glm::dvec3 Millionths(const glm::dvec3& v) { return {Millionths(v.x), Millionths(v.y), Millionths(v.z)}; }

/// Returns a joint's name in one line, without the characters that begin and end blocks.
std::string Printable(std::string_view name) {
  std::string printable(name);
  for (char& c : printable) {
    const bool is_control = static_cast<unsigned char>(c) < ' ' || c == '\x7F';
    if (is_control || c == '{' || c == '}') c = '_';
  }
  // Remove the spaces around the name.
  const std::size_t first = printable.find_first_not_of(' ');
  if (first == std::string::npos) return "unnamed";
  return printable.substr(first, printable.find_last_not_of(' ') - first + 1);
}

class Writer {
 public:
  explicit Writer(const Clip& clip) : clip_(clip), children_(clip.skeleton.joints.size()) {
    for (std::size_t i = 0; i < children_.size(); ++i) {
      const int parent = Joint(i).parent;
      if (parent >= 0) {
        children_[parent].push_back(static_cast<int>(i));
      } else {
        root_ = static_cast<int>(i);
      }
    }
  }

  std::string Write() {
    Print("HIERARCHY\n");
    WriteJoint(root_, 0);
    Print("MOTION\nFrames: {}\nFrame Time: {:.10f}\n", clip_.frames.size(), 1.0 / clip_.rate_hz);
    for (const LocalPose& pose : clip_.frames) WriteFrame(pose);
    return std::move(text_);
  }

 private:
  struct Column {
    int joint;
    bool has_positions;
  };

  template <typename... Args>
  void Print(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  const etude::Joint& Joint(std::size_t index) const { return clip_.skeleton.joints[index]; }

  /// Returns true if a joint's printed translation changes between frames.
  bool Moves(int joint) const {
    return std::ranges::any_of(clip_.frames, [&](const LocalPose& pose) {
      return Millionths(pose[joint].translation) != Millionths(clip_.frames.front()[joint].translation);
    });
  }

  void WriteJoint(int index, int depth) {
    const etude::Joint& joint = Joint(index);
    const std::string indent(depth, '\t');
    // Some readers replace OFFSET by the positions, others add OFFSET to the positions: if OFFSET is 0, all readers get
    // the same result.
    const bool has_positions = index == root_ || Moves(index);
    const bool is_end = joint.is_end_site && children_[index].empty() && !has_positions;
    if (is_end) {
      Print("{}End Site\n", indent);
    } else {
      Print("{}{} {}\n", indent, index == root_ ? "ROOT" : "JOINT", names_.Add(Printable(joint.name)));
    }
    Print("{}{{\n{}\tOFFSET ", indent, indent);
    const LocalTransform& still = clip_.frames.empty() ? joint.rest : clip_.frames.front()[index];
    PrintNumbers(has_positions ? glm::dvec3(0) : still.translation);
    text_.back() = '\n';
    if (!is_end) {
      columns_.push_back({index, has_positions});
      Print("{}\tCHANNELS {}Zrotation Xrotation Yrotation\n", indent,
            has_positions ? "6 Xposition Yposition Zposition " : "3 ");
    }
    for (int child : children_[index]) WriteJoint(child, depth + 1);
    Print("{}}}\n", indent);
  }

  /// Prints three numbers, each followed by a space.
  void PrintNumbers(const glm::dvec3& numbers) {
    for (int i = 0; i < 3; ++i) PrintNumber(Millionths(numbers[i]));
  }

  /// Prints a number that is given in millionths. Most of the writing time is spent in this function, so it assembles
  /// the digits itself.
  void PrintNumber(double millionths) {
    constexpr std::uint64_t kWhole = 1'000'000;
    if (millionths < 0) text_ += '-';
    const auto size = static_cast<std::uint64_t>(std::abs(millionths));
    const fmt::format_int whole(size / kWhole);
    // Adding kWhole puts a digit in front, which keeps leading zeros; this digit is not printed.
    const fmt::format_int fraction(kWhole + size % kWhole);
    text_.append(whole.data(), whole.size()).append(1, '.').append(fraction.data() + 1, fraction.size() - 1);
    text_ += ' ';
  }

  void WriteFrame(const LocalPose& pose) {
    for (const Column& column : columns_) {
      const LocalTransform& local = pose[column.joint];
      if (column.has_positions) PrintNumbers(local.translation);
      const EulerZxy angles = ToEulerZxy(local.rotation);
      PrintNumbers({Degrees(angles.z), Degrees(angles.x), Degrees(angles.y)});
    }
    text_.back() = '\n';
  }

  const Clip& clip_;
  std::vector<std::vector<int>> children_;
  int root_ = -1;
  std::vector<Column> columns_;  ///< the columns, in the order in which they are written
  UniqueNames names_;
  std::string text_;
};

}  // namespace

std::string WriteBvh(Clip clip) {
  assert(!clip.skeleton.joints.empty());
  return Writer(WithWorldAxesAtRest(WithOneRoot(WithoutScales(std::move(clip))))).Write();
}

}  // namespace etude
