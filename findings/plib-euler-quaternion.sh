#!/usr/bin/env bash
# PLIB 1.8.5's sgEulerToQuat reverses heading, pitch and roll and exchanges the axes of pitch and roll; sgHPRToQuat
# makes half a degree of thirty.
#
# PLIB's angles are heading about Z, pitch about X and roll about Y, in degrees; so its matrices of three angles have
# them, and sgSetCoord reads them back. Its quaternions agree with its matrices for an axis and an angle. But
# sgEulerToQuat, whose parameter is called hpr, turns heading about -Z, pitch about -Y and roll about -X. sgQuatToEuler
# returns its angles in the reverse order of sgEulerToQuat. sgHPRToQuat converts the angles to radians before it calls
# sgEulerToQuat, which converts them once more, so that every turn is 57 times too small. The header documents no
# other convention.
#
# Needs: curl, dpkg-deb and g++, Debian 12 or later, x86-64. Downloads 1.3 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for package in libplib-dev libplib1; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/p/plib/${package}_1.8.5-14+b1_amd64.deb"
  dpkg-deb -x package.deb unpacked
done

cat > angles.cc <<'CODE'
#include <cmath>
#include <cstdio>
#include <plib/sg.h>

// Prints the axis about which a matrix turns (x, y or z), and the angle in degrees. Row i of a matrix of PLIB is the
// image of axis i.
static void Turn(const char* what, const sgMat4 m) {
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    if (m[axis][axis] < 0.999999f) continue;
    const double degrees = std::atan2(m[a][b], m[a][a]) * 180 / M_PI;
    if (std::fabs(degrees) > 0.01) std::printf("%s%c %+.1f", what, "xyz"[axis], degrees);
  }
}

static void Turn(const char* what, const sgQuat q) {
  sgMat4 m;
  sgQuatToMatrix(m, q);
  Turn(what, m);
}

int main() {
  const char* names[] = {"heading", "pitch", "roll"};
  sgMat4 matrix;
  sgQuat quaternion;
  for (int i = 0; i < 3; ++i) {
    sgVec3 hpr = {0, 0, 0};
    hpr[i] = 30;
    sgMakeRotMat4(matrix, hpr[0], hpr[1], hpr[2]);
    std::printf("%s 30:", names[i]);
    Turn(" sgMakeRotMat4 ", matrix);
    sgEulerToQuat(quaternion, hpr);
    Turn(", sgEulerToQuat ", quaternion);
    sgHPRToQuat(quaternion, hpr);
    Turn(", sgHPRToQuat ", quaternion);
    std::puts("");
  }
  for (int i = 0; i < 3; ++i) {
    sgVec3 axis = {0, 0, 0};
    axis[i] = 1;
    sgMakeRotMat4(matrix, 30, axis);
    std::printf("30 about %c:", "xyz"[i]);
    Turn(" sgMakeRotMat4 ", matrix);
    sgAngleAxisToQuat(quaternion, 30, axis);
    Turn(", sgAngleAxisToQuat ", quaternion);
    std::puts("");
  }
  sgVec3 back, hpr = {20, 30, 40};
  sgEulerToQuat(quaternion, hpr);
  sgQuatToEuler(back, quaternion);
  std::printf("20 30 40, to a quaternion and back: %.1f %.1f %.1f\n", back[0], back[1], back[2]);
  sgCoord coordinates;
  sgMakeRotMat4(matrix, hpr[0], hpr[1], hpr[2]);
  sgSetCoord(&coordinates, matrix);
  std::printf("20 30 40, to a matrix and back: %.1f %.1f %.1f\n", coordinates.hpr[0], coordinates.hpr[1],
              coordinates.hpr[2]);
  sgMatrixToQuat(quaternion, matrix);
  sgQuatToEuler(back, quaternion);
  std::printf("20 30 40, to a matrix, a quaternion and back: %.1f %.1f %.1f\n", back[0], back[1], back[2]);
}
CODE
g++ -O1 -w -isystem unpacked/usr/include angles.cc -o angles unpacked/usr/lib/x86_64-linux-gnu/libplib{sg,ul}.a
echo 'PLIB 1.8.5 (Debian 12):'
./angles | tee said

cat > expected <<'SAID'
heading 30: sgMakeRotMat4 z +30.0, sgEulerToQuat z -30.0, sgHPRToQuat z -0.5
pitch 30: sgMakeRotMat4 x +30.0, sgEulerToQuat y -30.0, sgHPRToQuat y -0.5
roll 30: sgMakeRotMat4 y +30.0, sgEulerToQuat x -30.0, sgHPRToQuat x -0.5
30 about x: sgMakeRotMat4 x +30.0, sgAngleAxisToQuat x +30.0
30 about y: sgMakeRotMat4 y +30.0, sgAngleAxisToQuat y +30.0
30 about z: sgMakeRotMat4 z +30.0, sgAngleAxisToQuat z +30.0
20 30 40, to a quaternion and back: 40.0 30.0 20.0
20 30 40, to a matrix and back: 20.0 30.0 40.0
20 30 40, to a matrix, a quaternion and back: -11.9 -47.3 -25.9
SAID
diff expected said
echo 'As described: angles by quaternion are others than angles by matrix.'
