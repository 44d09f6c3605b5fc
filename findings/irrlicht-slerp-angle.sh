#!/usr/bin/env bash
# After Irrlicht 1.8.5's slerp between two rotations less than 36 degrees apart, toAngleAxis gives wrong angles: a tenth
# of a turn is read as a third of it.
#
# The header says that slerp becomes linear near the end, when the time is above 1 minus a threshold (0.05), to avoid
# inaccuracies. But slerp compares the threshold with the cosine between the quaternions: if they are less than 36
# degrees apart, it is linear all the way. The result is then a quaternion that is shorter than 1. toAngleAxis takes the
# arc cosine of w alone: on the way from rest to a turn, however small, the angle grows as the square root of the time,
# so a limb that starts to move seems to jump. With a threshold of 0, or after normalize(), the angles are right to 0.1
# degrees. Neither slerp nor toAngleAxis mentions it.
#
# Needs: curl, dpkg-deb and g++. Downloads 2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

curl -sSfo package.deb 'http://deb.debian.org/debian/pool/main/i/irrlicht/libirrlicht-dev_1.8.5+ds2-1_amd64.deb'
dpkg-deb -x package.deb root

cat > slerp.cc <<'CODE'
#include <irrlicht/irrlicht.h>

#include <cstdio>
#include <initializer_list>

using namespace irr::core;

float AngleDegrees(const quaternion& turn) {
  float angle;
  vector3df axis;
  turn.toAngleAxis(angle, axis);
  return angle * RADTODEG;
}

int main() {
  const quaternion rest;
  for (const float turn : {10.0f, 20.0f, 36.0f, 37.0f}) {
    const quaternion end = quaternion().fromAngleAxis(turn * DEGTORAD, vector3df(0, 0, 1));
    std::printf("0 to %g degrees\n", turn);
    for (const float time : {0.1f, 0.5f}) {
      quaternion usual, unit, spherical;
      usual.slerp(rest, end, time);
      unit.slerp(rest, end, time).normalize();
      spherical.slerp(rest, end, time, 0);
      std::printf("  %4.1f: %4.1f, normalised %4.1f, threshold 0 %4.1f\n", time * turn, AngleDegrees(usual),
                  AngleDegrees(unit), AngleDegrees(spherical));
    }
  }
}
CODE
g++ -O1 -w -std=c++17 -isystem root/usr/include slerp.cc -o slerp
./slerp | tee said

cat > expected <<'SAID'
0 to 10 degrees
   1.0:  3.2, normalised  1.0, threshold 0  1.0
   5.0:  7.1, normalised  5.0, threshold 0  5.0
0 to 20 degrees
   2.0:  6.3, normalised  2.0, threshold 0  2.0
  10.0: 14.1, normalised 10.0, threshold 0 10.0
0 to 36 degrees
   3.6: 11.3, normalised  3.6, threshold 0  3.6
  18.0: 25.4, normalised 18.0, threshold 0 18.0
0 to 37 degrees
   3.7:  3.7, normalised  3.7, threshold 0  3.7
  18.5: 18.5, normalised 18.5, threshold 0 18.5
SAID
diff expected said
echo 'As described: small turns are read too large.'
