#!/usr/bin/env bash
# CQRlib 1.1.4's angles of a quaternion depend on what the variables for the result held before; half of the time they
# are the angles of another rotation.
#
# CQRQuaternion2Angles computes two triples of angles and returns the one that is nearer to the old content of its three
# output variables; the manual does not say so. The first triple x, y, z is right. The second should be x + 180, 180 -
# y, z + 180 for the convention Rz Ry Rx that the manual names, but is x + 180, y + 180, z + 180: the rotation with the
# opposite turn about Y. A program that leaves the variables unset, as one may with a result, gets either. If it sets
# them to zero, 28 % of all rotations are wrong. CQRAngles2Quaternion, the inverse, is right.
#
# Needs: curl, dpkg-deb and gcc, x86-64. Downloads 0.1 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

curl -sSfo package.deb 'http://deb.debian.org/debian/pool/main/c/cqrlib/libcqrlib-dev_1.1.4-3_amd64.deb'
dpkg-deb -x package.deb root

cat > angles.c <<'CODE'
#include <cqrlib.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>

static const double kPi = 3.14159265358979323846;
static uint64_t state = 1;
static double Next() {  // in [-1, 1)
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (double)(state >> 11) / 4503599627370496.0 - 1;
}
static void Turn(double matrix[3][3], double x, double y, double z) {  // Rz Ry Rx, in closed form
  const double a = cos(x), b = sin(x), c = cos(y), d = sin(y), e = cos(z), f = sin(z);
  const double rows[3][3] = {{e * c, e * d * b - f * a, e * d * a + f * b}, {f * c, f * d * b + e * a, f * d * a - e * b}, {-d, c * b, c * a}};
  for (int i = 0; i < 9; ++i) matrix[i / 3][i % 3] = rows[i / 3][i % 3];
}
static int Same(double a[3][3], double b[3][3]) {
  for (int i = 0; i < 9; ++i)
    if (fabs(a[i / 3][i % 3] - b[i / 3][i % 3]) > 1e-6) return 0;
  return 1;
}

// Of 100,000 rotations: how many go through the quaternion unchanged, or with the opposite turn about Y?
static void Count(const char* what, int random) {
  int count = 0, built = 0, right = 0, reversed = 0;
  for (; count < 100000; ++count) {
    const double x = Next() * kPi, y = Next() * kPi / 2, z = Next() * kPi;
    double meant[3][3], opposite[3][3], found[3][3], results[3];
    for (int i = 0; i < 3; ++i) results[i] = random * Next() * kPi;
    CQRQuaternion q;
    CQRAngles2Quaternion(&q, x, y, z);
    CQRQuaternion2Matrix(found, &q);
    Turn(meant, x, y, z);
    Turn(opposite, x, -y, z);
    built += Same(found, meant);
    CQRQuaternion2Angles(&results[0], &results[1], &results[2], &q);
    Turn(found, results[0], results[1], results[2]);
    right += Same(found, meant);
    reversed += !Same(found, meant) && Same(found, opposite);
  }
  printf("%s: quaternions %.0f %% right, angles %.0f %% right, %.0f %% reversed about Y\n", what, 100. * built / count, 100. * right / count,
         100. * reversed / count);
}

int main() {
  for (int old = 0; old <= 180; old += 180) {
    double results[3] = {old * kPi / 180, old * kPi / 180, old * kPi / 180};
    CQRQuaternion q;
    CQRAngles2Quaternion(&q, 10 * kPi / 180, 20 * kPi / 180, 30 * kPi / 180);
    CQRQuaternion2Angles(&results[0], &results[1], &results[2], &q);
    printf("10 20 30 into variables that hold %d: ", old);
    for (int i = 0; i < 3; ++i) printf("%.0f%c", results[i] * 180 / kPi, i < 2 ? ' ' : '\n');
  }
  Count("variables hold zero", 0);
  Count("variables hold anything", 1);
}
CODE
gcc -O1 -w -isystem root/usr/include angles.c -o angles root/usr/lib/x86_64-linux-gnu/libCQRlib.a -lm
echo 'CQRlib 1.1.4 (Debian 12):'
./angles | tee said

diff - said <<'EXPECTED'
10 20 30 into variables that hold 0: 10 20 30
10 20 30 into variables that hold 180: 190 200 210
variables hold zero: quaternions 100 % right, angles 72 % right, 28 % reversed about Y
variables hold anything: quaternions 100 % right, angles 50 % right, 50 % reversed about Y
EXPECTED
echo 'As described: the old content decides.'
