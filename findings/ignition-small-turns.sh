#!/usr/bin/env bash
# Ignition Math 6.10.0 gives a turn of less than 0.114 degrees an angle of 0 about X: at 1000 Hz, speeds below 114 degrees a second vanish.
#
# Quaternion::ToAxis, documented to return the rotation as axis and angle, returns no rotation if the vector part's squared length is at
# most a millionth. Quaternion::Scale, which uses ToAxis, loses such turns too. Log of the same quaternion keeps them. At 100 degrees a
# second, the turn between two frames gives 100 at 30 Hz and 0 at 1000 Hz.
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

cat > speed.cc <<'CODE'
#include <ignition/math/Quaternion.hh>

#include <cstdio>

using ignition::math::Quaterniond;
using ignition::math::Vector3d;

int main() {
  const double degree = IGN_PI / 180, speed = 100;  // degrees a second about Z
  for (const double rate : {30.0, 240.0, 900.0, 1000.0}) {
    const Quaterniond turn(Vector3d(0, 0, 1), speed / rate * degree);
    Vector3d axis;
    double angle;
    turn.ToAxis(axis, angle);
    Quaterniond doubled = turn;
    doubled.Scale(2);
    std::printf("%4g Hz: ToAxis %g degrees/s about (%g, %g, %g); Scale(2) %g; Log %g\n", rate, angle / degree * rate, axis.X(), axis.Y(),
                axis.Z(), doubled.Yaw() / degree * rate, 2 * turn.Log().Z() / degree * rate);
  }
}
CODE
g++ -O1 -w -std=c++17 -isystem unpacked/usr/include/ignition/math6 speed.cc -o speed \
  unpacked/usr/lib/x86_64-linux-gnu/libignition-math6.so.6 -Wl,-rpath,"$folder/unpacked/usr/lib/x86_64-linux-gnu"
./speed | tee said

cat > expected <<'SAID'
  30 Hz: ToAxis 100 degrees/s about (0, 0, 1); Scale(2) 200; Log 100
 240 Hz: ToAxis 100 degrees/s about (0, 0, 1); Scale(2) 200; Log 100
 900 Hz: ToAxis 0 degrees/s about (1, 0, 0); Scale(2) 0; Log 100
1000 Hz: ToAxis 0 degrees/s about (1, 0, 0); Scale(2) 0; Log 100
SAID
diff expected said
echo 'As described: at high rates the turns are lost.'
