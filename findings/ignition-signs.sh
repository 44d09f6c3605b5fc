#!/usr/bin/env bash
# Ignition Math 6.10.0's RotationSpline and OnePoleQuaternion take the long way round if a quaternion's sign changes, as at yaw 180.
#
# q and -q are one rotation. RotationSpline::Interpolate takes the shortest path by default, as documented, but its
# tangents do not: between keys at 140, 160 and -170 degrees of yaw, which are 20 and 30 degrees apart, the spline
# swings far beyond both keys. OnePoleQuaternion, a low-pass filter, does not choose the shortest path: after a step of
# 20 degrees across 180 it turns by 340. Quaternions from Euler angles, as here, change their sign at a yaw of 180
# degrees. Keys at the same steps from 40 degrees on are joined smoothly.
#
# Needs: curl, dpkg-deb and g++. Downloads 0.3 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for package in libignition-math-dev libignition-math6-6; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/i/ignition-math/${package}_6.10.0+ds3-7+b4_amd64.deb"
  dpkg-deb -x package.deb unpacked
done

cat > signs.cc <<'CODE'
#include <ignition/math/Filter.hh>
#include <ignition/math/RotationSpline.hh>

#include <cstdio>

using ignition::math::OnePoleQuaternion;
using ignition::math::Quaterniond;
using ignition::math::RotationSpline;

const double kDegree = IGN_PI / 180;

void Say(const Quaterniond& turn) { std::printf(" %.0f", turn.Yaw() / kDegree); }

int main() {
  for (const double start : {40.0, 140.0}) {
    RotationSpline spline;
    for (const double yaw : {start, start + 20, start + 50, start + 80})
      spline.AddPoint(Quaterniond(0, 0, yaw > 180 ? (yaw - 360) * kDegree : yaw * kDegree));
    std::printf("spline from %g by 20, 30 and 30:", start);
    for (int i = 0; i <= 12; ++i) Say(spline.Interpolate(i / 12.0));
    OnePoleQuaternion filter(5, 100);
    filter.Set(Quaterniond(0, 0, (start + 30) * kDegree));
    const double goal = start + 50 > 180 ? start - 310 : start + 50;
    std::printf("\nfilter from %g to %g:", start + 30, goal);
    for (int i = 0; i < 12; ++i) Say(filter.Process(Quaterniond(0, 0, goal * kDegree)));
    std::printf("\n");
  }
}
CODE
g++ -O1 -w -std=c++17 -isystem unpacked/usr/include/ignition/math6 signs.cc -o signs \
  unpacked/usr/lib/x86_64-linux-gnu/libignition-math6.so.6 -Wl,-rpath,"$folder/unpacked/usr/lib/x86_64-linux-gnu"
./signs | tee said

cat > expected <<'SAID'
spline from 40 by 20, 30 and 30: 40 43 48 54 60 67 74 82 90 98 107 115 120
filter from 70 to 90: 75 79 82 84 86 87 88 88 89 89 89 90
spline from 140 by 20, 30 and 30: 140 152 171 179 160 -143 -96 -93 -170 173 -176 -154 -140
filter from 170 to -170: 78 11 -38 -73 -99 -118 -132 -142 -150 -155 -159 -162
SAID
diff expected said
echo 'As described: only the motion away from 180 degrees goes the short way.'
