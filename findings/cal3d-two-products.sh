#!/usr/bin/env bash
# Cal3D 0.11's a *= b and a * b are different products of the same two quaternions: each is the other with a and b exchanged.
#
# CalQuaternion's operator*= gives Hamilton's product a b, operator* gives b a; the header documents neither order. Code that replaces
# `bone *= parent` by `bone = bone * parent` composes the rotations in the other order. Moreover, a vector that is multiplied by a
# quaternion turns by the opposite angle: +90 degrees about Z takes X to -Y.
#
# Needs: curl, dpkg-deb and g++. Downloads 0.3 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for package in libcal3d12-dev libcal3d12v5; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/c/cal3d/${package}_0.11.0-8_amd64.deb"
  dpkg-deb -x package.deb root
done

cat > products.cc <<'CODE'
#include <cal3d/cal3d.h>
#include <cmath>
#include <cstdio>

int main() {
  const float h = std::sqrt(0.5f);
  CalQuaternion about_x(h, 0, 0, h), about_z(0, 0, h, h);  // 90 degrees each; x, y, z, w
  CalQuaternion in_place = about_z;
  in_place *= about_x;
  const CalQuaternion apart = about_z * about_x, exchanged = about_x * about_z;
  const auto say = [](const char* what, const CalQuaternion& q) { std::printf("%s: %.1f %.1f %.1f %.1f\n", what, q.x, q.y, q.z, q.w); };
  say("z *= x", in_place);
  say("z * x ", apart);
  say("x * z ", exchanged);
  CalVector turned(1, 0, 0);
  turned *= about_z;
  std::printf("X turned by 90 degrees about Z: %.0f %.0f %.0f\n", turned.x, turned.y, turned.z);
}
CODE
libraries=$(dirname "$(find root -name 'libcal3d.so.12')")
g++ -O1 -w -isystem root/usr/include products.cc -o products "$libraries"/libcal3d.so.12
echo 'Cal3D 0.11.0 (Debian 12), Hamilton'\''s product of z and x is 0.5 0.5 0.5 0.5:'
LD_LIBRARY_PATH=$libraries ./products | tee said

diff - said <<'EXPECTED'
z *= x: 0.5 0.5 0.5 0.5
z * x : 0.5 -0.5 0.5 0.5
x * z : 0.5 0.5 0.5 0.5
X turned by 90 degrees about Z: 0 -1 0
EXPECTED
echo 'As described: the two operators multiply in opposite orders.'
