#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/number_rows.h"

namespace etude {

/// The columns of a table with one row of joints per frame.
struct KinectColumns {
  std::size_t joints = 0;     ///< 20 (Kinect v1) or 25 (Kinect v2)
  std::size_t first = 0;      ///< index of the first joint's first number
  std::size_t per_joint = 3;  ///< numbers for each joint; the first three are x, y and z
};

/// Returns, for each joint in the SDK's order, which joint of the row it is, by the names in the table's heading.
/// Returns an empty list if the heading names no joints, because then the rows are in the SDK's order. Headings name
/// the joints as the SDK does or as Etude does, in any case, with the side before or behind ("HipLeft", "left_hip"),
/// and with any other words ("HipLeft_position_x"). There is one heading for each number, or one for each joint, and
/// then the headings of a joint's other numbers may be empty. Fails if a heading names no joint of this Kinect, if a
/// joint is missing or occurs twice, or if a joint's x, y and z are not adjacent and in this order.
Result<std::vector<std::size_t>> FindKinectJoints(const NumberRows& table, const KinectColumns& columns,
                                                  const std::string& file);

}  // namespace etude
