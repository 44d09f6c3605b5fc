#!/usr/bin/env bash
# GLM 0.9.9.8's pow(q, 1) is not q for one unit quaternion in forty, and angle(q) belongs to another rotation.
#
# If |w| exceeds cos(1/2), pow and angle compute the angle from the vector part, which keeps more digits, but ignore
# the sign of w: below -0.878 the angle is wrong. For a turn of 344 degrees, which is the same rotation as one of -16,
# they get 16 degrees, the opposite rotation; pow(q, 0.5), which blends poses, then turns by 8 degrees instead of -8.
# Half of all products of quaternions have a negative w. axis(q) and slerp are right. Debian 12 and 13 contain this
# version; 1.0.1 corrects angle, but not pow.
#
# Needs: curl, dpkg-deb and g++. Downloads 0.2 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

curl -sSfo package.deb 'http://deb.debian.org/debian/pool/main/g/glm/libglm-dev_0.9.9.8+ds-6_all.deb'
dpkg-deb -x package.deb root

cat > angles.cc <<'CODE'
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>

#include <cstdint>
#include <cstdio>
#include <initializer_list>

static std::uint64_t state = 1;
static double Next() {  // in [-1, 1)
  state = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 11) / 4503599627370496.0 - 1;
}
static bool SameRotation(const glm::dquat& a, const glm::dquat& b) { return glm::abs(glm::dot(a, b)) > 1 - 1e-9; }

int main() {
  std::printf("GLM %d.%d.%d.%d\n", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH, GLM_VERSION_REVISION);
  for (const double degrees : {16.0, 200.0, 300.0, 344.0}) {
    const glm::dquat q = glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 0, 1));
    const glm::dquat one = glm::pow(q, 1.0), half = glm::pow(q, 0.5);
    std::printf("%.0f degrees about Z: angle %.0f, w %.3f, w of pow 1 %.3f; pow 0.5, twice: %s\n", degrees, glm::degrees(glm::angle(q)),
                q.w, one.w, SameRotation(half * half, q) ? "the same rotation" : "another rotation");
  }
  int count = 0, angles = 0, powers = 0;
  while (count < 100000) {
    glm::dquat q(Next(), Next(), Next(), Next());
    const double length = glm::length(q);
    if (length > 1 || length < 0.1) continue;
    q /= length;
    ++count;
    angles += !SameRotation(glm::angleAxis(glm::angle(q), glm::axis(q)), q);
    powers += !SameRotation(glm::pow(q, 1.0), q);
  }
  std::printf("of %d unit quaternions, evenly spread: angle and axis give another rotation for %d, pow 1 for %d\n", count, angles, powers);
}
CODE
g++ -O1 -w -std=c++17 -isystem root/usr/include angles.cc -o angles
./angles | tee said

cat > expected <<'SAID'
GLM 0.9.9.8
16 degrees about Z: angle 16, w 0.990, w of pow 1 0.990; pow 0.5, twice: the same rotation
200 degrees about Z: angle 200, w -0.174, w of pow 1 -0.174; pow 0.5, twice: the same rotation
300 degrees about Z: angle 300, w -0.866, w of pow 1 -0.866; pow 0.5, twice: the same rotation
344 degrees about Z: angle 16, w -0.990, w of pow 1 0.990; pow 0.5, twice: another rotation
of 100000 unit quaternions, evenly spread: angle and axis give another rotation for 2355, pow 1 for 2355
SAID
diff expected said
echo 'The behaviour is as described.'
