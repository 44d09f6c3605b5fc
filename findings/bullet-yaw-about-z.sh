#!/usr/bin/env bash
# Bullet 3.24's btMatrix3x3::setEulerYPR applies yaw about Z; its documentation and btQuaternion::setEuler use Y.
#
# LinearMath/btMatrix3x3.h documents setEulerYPR as "yaw about Y axis, pitch about X axis, roll about Z axis", which
# is what btQuaternion::setEuler(yaw, pitch, roll) does. But the function calls setEulerZYX(roll, pitch, yaw): yaw
# about Z, pitch about Y, roll about X. getEulerYPR has the same fault, so a round trip through the matrix hides it.
# Angles that are written to a matrix and read from a quaternion made of it, or the other way round, become another
# rotation. All angles are valid; none is near a pole.
#
# Needs: curl, dpkg-deb and g++. Downloads 0.4 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

curl -sSfo package.deb 'http://deb.debian.org/debian/pool/main/b/bullet/libbullet-dev_3.24+dfsg-2_amd64.deb'
dpkg-deb -x package.deb root

cat > yaw.cc <<'CODE'
#include <LinearMath/btMatrix3x3.h>
#include <LinearMath/btQuaternion.h>

#include <cstdio>

static void Say(const char* what, const btMatrix3x3& matrix) {
  btQuaternion turn;
  matrix.getRotation(turn);
  const btVector3 axis = turn.getAxis();
  std::printf("%s: %.3f about (%.3f, %.3f, %.3f)\n", what, turn.getAngle(), axis.x(), axis.y(), axis.z());
}

int main() {
  const char* const names[3] = {"yaw", "pitch", "roll"};
  for (int i = 0; i < 3; ++i) {
    const btScalar yaw = i == 0 ? 0.5 : 0, pitch = i == 1 ? 0.5 : 0, roll = i == 2 ? 0.5 : 0;
    btQuaternion quaternion;
    quaternion.setEuler(yaw, pitch, roll);
    btMatrix3x3 matrix;
    matrix.setEulerYPR(yaw, pitch, roll);
    std::printf("%s of 0.5\n", names[i]);
    Say("  btQuaternion::setEuler    ", btMatrix3x3(quaternion));
    Say("  btMatrix3x3::setEulerYPR  ", matrix);
  }
  btScalar yaw, pitch, roll;
  btMatrix3x3(btQuaternion(btVector3(0, 1, 0), 0.5)).getEulerYPR(yaw, pitch, roll);
  std::printf("getEulerYPR of 0.5 about Y: yaw %.3f, pitch %.3f, roll %.3f\n", yaw, pitch, roll);
}
CODE
g++ -O1 -w -std=c++17 -DBT_USE_DOUBLE_PRECISION -isystem root/usr/include/bullet yaw.cc -o yaw
echo 'Bullet 3.24 (Debian 12):'
./yaw | tee said

cat > expected <<'SAID'
yaw of 0.5
  btQuaternion::setEuler    : 0.500 about (0.000, 1.000, 0.000)
  btMatrix3x3::setEulerYPR  : 0.500 about (0.000, 0.000, 1.000)
pitch of 0.5
  btQuaternion::setEuler    : 0.500 about (1.000, 0.000, 0.000)
  btMatrix3x3::setEulerYPR  : 0.500 about (0.000, 1.000, 0.000)
roll of 0.5
  btQuaternion::setEuler    : 0.500 about (0.000, 0.000, 1.000)
  btMatrix3x3::setEulerYPR  : 0.500 about (1.000, 0.000, 0.000)
getEulerYPR of 0.5 about Y: yaw 0.000, pitch 0.500, roll 0.000
SAID
diff expected said
echo 'As described: the two functions give the same angle to three other axes.'
