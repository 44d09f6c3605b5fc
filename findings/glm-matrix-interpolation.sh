#!/usr/bin/env bash
# GLM 0.9.9.8 finds an angle of 45 degrees in every rotation matrix, so that interpolate(a, b, 1) is not b but a,
# turned by 45 degrees.
#
# axisAngle of GLM_GTX_matrix_interpolation returns the right axis, but a quarter of pi for every matrix: a guard
# against an acos of more than 1 compares the wrong way, and always applies. The extension "allows to directly
# interpolate two matrices"; half-way between 10 and 30 degrees it gives 32.5. Debian 12 and 13 contain this version;
# 1.0.1 is right. Quaternions and their slerp are right in both.
#
# Needs: curl, dpkg-deb and g++. Downloads 0.2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

curl -sSfo package.deb 'http://deb.debian.org/debian/pool/main/g/glm/libglm-dev_0.9.9.8+ds-6_all.deb'
dpkg-deb -x package.deb root

cat > between.cc <<'CODE'
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/matrix_interpolation.hpp>

#include <cstdio>
#include <initializer_list>

static glm::dmat4 Turn(double degrees) { return glm::mat4_cast(glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 0, 1))); }
static double Degrees(const glm::dmat4& turn) { return glm::degrees(glm::atan(turn[0][1], turn[0][0])); }

int main() {
  std::printf("GLM %d.%d.%d.%d\n", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH, GLM_VERSION_REVISION);
  for (const double degrees : {5.0, 30.0, 60.0, 90.0, 150.0}) {
    glm::dvec3 axis;
    double angle;
    glm::axisAngle(Turn(degrees), axis, angle);
    std::printf("axisAngle of %.0f degrees about Z: %.1f about (%.1f, %.1f, %.1f)\n", degrees, glm::degrees(angle), axis.x, axis.y, axis.z);
  }
  for (const double t : {0.0, 0.5, 1.0}) {
    const glm::dquat slerp = glm::slerp(glm::quat_cast(Turn(10)), glm::quat_cast(Turn(30)), t);
    std::printf("from 10 to 30 degrees, at %.1f: interpolate %.1f, slerp %.1f\n", t, Degrees(glm::interpolate(Turn(10), Turn(30), t)),
                Degrees(glm::mat4_cast(slerp)));
  }
}
CODE
g++ -O1 -w -std=c++17 -isystem root/usr/include between.cc -o between
./between | tee said

cat > expected <<'SAID'
GLM 0.9.9.8
axisAngle of 5 degrees about Z: 45.0 about (0.0, 0.0, 1.0)
axisAngle of 30 degrees about Z: 45.0 about (0.0, 0.0, 1.0)
axisAngle of 60 degrees about Z: 45.0 about (0.0, 0.0, 1.0)
axisAngle of 90 degrees about Z: 45.0 about (0.0, 0.0, 1.0)
axisAngle of 150 degrees about Z: 45.0 about (0.0, 0.0, 1.0)
from 10 to 30 degrees, at 0.0: interpolate 10.0, slerp 10.0
from 10 to 30 degrees, at 0.5: interpolate 32.5, slerp 20.0
from 10 to 30 degrees, at 1.0: interpolate 55.0, slerp 30.0
SAID
diff expected said
echo 'The behaviour is as described.'
