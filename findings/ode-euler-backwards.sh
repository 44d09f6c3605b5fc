#!/usr/bin/env bash
# ODE 0.16.2's dRFromEulerAngles turns the opposite way to dRFromAxisAndAngle: an angle of 0.5 about X gives a
# rotation by -0.5.
#
# The manual says of both only that they create a rotation matrix from angles. For the same angle about the same axis,
# one matrix is the transpose of the other. dQFromAxisAndAngle follows the right-hand rule, as dRFromAxisAndAngle
# does, so a rotation made from Euler angles is the inverse of the one that these two functions make.
#
# Needs: curl, dpkg-deb and gcc, x86-64. Downloads 1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for path in o/ode/libode-dev_0.16.2-1 o/ode/libode8_0.16.2-1 libc/libccd/libccd2_2.1-2+b1; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/${path}_amd64.deb"
  dpkg-deb -x package.deb unpacked
done

cat > turn.c <<'CODE'
#include <math.h>
#include <ode/ode.h>
#include <stdio.h>

static double Angle(const dMatrix3 R, int axis) { /* the right-handed angle about one axis; ODE keeps four numbers a row */
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  return atan2(R[4 * b + a], R[4 * a + a]);
}

int main(void) {
  for (int axis = 0; axis < 3; ++axis) {
    const double angle[3] = {axis == 0 ? 0.5 : 0, axis == 1 ? 0.5 : 0, axis == 2 ? 0.5 : 0};
    dMatrix3 euler, plain, fromQuaternion;
    dQuaternion quaternion;
    dRFromEulerAngles(euler, angle[0], angle[1], angle[2]);
    dRFromAxisAndAngle(plain, axis == 0, axis == 1, axis == 2, 0.5);
    dQFromAxisAndAngle(quaternion, axis == 0, axis == 1, axis == 2, 0.5);
    dRfromQ(fromQuaternion, quaternion);
    printf("0.5 about %c: Euler %+.3f, axis and angle %+.3f, quaternion %+.3f\n", "XYZ"[axis], Angle(euler, axis), Angle(plain, axis),
           Angle(fromQuaternion, axis));
  }
  return 0;
}
CODE
gcc -O1 -w -DdIDEDOUBLE -isystem unpacked/usr/include turn.c -o turn unpacked/usr/lib/x86_64-linux-gnu/libode.so.8 -lm -Wl,--allow-shlib-undefined
echo 'ODE 0.16.2 (Debian 12):'
LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) ./turn | tee said

for axis in X Y Z; do echo "0.5 about $axis: Euler -0.500, axis and angle +0.500, quaternion +0.500"; done | diff - said
echo 'As described: Euler angles turn backwards.'
