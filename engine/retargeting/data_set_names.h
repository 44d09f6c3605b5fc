#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/raw_motion.h"

namespace etude {

/// A joint of a data set, by its name in JointLayouts (a joint that plays a role has the role's name). Its position is
/// the mean of some points of a file, usually of one point.
struct KnownJoint {
  std::string joint;
  std::vector<std::size_t> points;  ///< indices of the points' names
};

/// A data set, and the joints of the data set that a file's points are, according to the points' names.
struct DataSetJoints {
  std::string_view data_set;
  std::vector<KnownJoint> joints;
};

/// Finds the data set whose published code names its joints like these points. One word can mean different joints in
/// different data sets: "neck" is the base of the neck in SMPL, but not in Human3.6M, which calls that joint "thorax".
/// Returns nullopt if no known data set has these names. Case and separators are ignored, and sides may be written as
/// in "left_hip", "LHip", "L_Hip" or "HipLeft".
std::optional<DataSetJoints> FindDataSet(std::span<const std::string> names);

/// Returns a name in lower case without separators; with a side, as in "left_hip". Text before a colon is left out.
std::string PlainJointName(std::string_view name);

/// Returns the index of a joint of a set (JointLayouts) in a motion; −1 if the motion lacks it. In a motion of points,
/// the joint may have the name that its data set's code gives it.
int FindJoint(const RawMotion& motion, std::string_view joint);

}  // namespace etude
