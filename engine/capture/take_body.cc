#include "engine/capture/take_body.h"

#include <cassert>

namespace etude {
namespace {

constexpr std::array<double LimbLengths::*, 10> kLengths = {
    &LimbLengths::foot,    &LimbLengths::shank, &LimbLengths::thigh,          &LimbLengths::hip_width,
    &LimbLengths::trunk,   &LimbLengths::neck,  &LimbLengths::shoulder_width, &LimbLengths::upper_arm,
    &LimbLengths::forearm, &LimbLengths::hand};
static_assert(sizeof(LimbLengths) == kLengths.size() * sizeof(double), "every length stands in the list");

// All offsets are linear in the lengths: what a metre of one adds is the body that has no other.
void AddLengths(const LimbLengths& lengths, TakeBody& made) {
  const auto list = ListOf(lengths);
  made.measurable.lengths.assign(list.begin(), list.end());
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::array<double, 10> one{};
    one[i] = 1;
    const CaptureBody unit = PaperBody(LimbLengthsOf(one));
    const int length = static_cast<int>(i);
    for (std::size_t j = 0; j < unit.tree.joints.size(); ++j) {
      const glm::dvec3& offset = unit.tree.joints[j].p_PJ;
      if (offset != glm::dvec3(0)) made.measurable.joint_shares.push_back({static_cast<int>(j), length, offset});
    }
    for (const Role role : AllRoles()) {
      const int point = made.points[Index(role)];
      const glm::dvec3& offset = unit.roles[Index(role)].p_LQ;
      if (point >= 0 && offset != glm::dvec3(0)) made.measurable.point_shares.push_back({point, length, offset});
    }
  }
}

}  // namespace

LimbLengths LimbLengthsOf(std::span<const double> lengths) {
  assert(lengths.size() == kLengths.size());
  LimbLengths limbs;
  for (std::size_t i = 0; i < kLengths.size(); ++i) limbs.*kLengths[i] = lengths[i];
  return limbs;
}

std::array<double, 10> ListOf(const LimbLengths& lengths) {
  std::array<double, 10> list{};
  for (std::size_t i = 0; i < kLengths.size(); ++i) list[i] = lengths.*kLengths[i];
  return list;
}

TakeBody MakeTakeBody(const LimbLengths& lengths) {
  TakeBody made;
  made.body = PaperBody(lengths);
  made.measurable.tree = made.body.tree;
  made.points.fill(-1);
  for (const Role role : AllRoles()) {
    if (role == Role::kHipCentre || role == Role::kSpine) continue;
    const TreePoint& place = made.body.roles[Index(role)];
    made.points[Index(role)] = static_cast<int>(made.measurable.points.size());
    made.measurable.points.push_back({place.joint, place.p_LQ});
  }
  AddLengths(lengths, made);
  return made;
}

}  // namespace etude
