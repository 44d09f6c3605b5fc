// Calibrates two cameras, triangulates a point and captures a motion. What the cameras see is projected from a clip, so
// that the truth is known: two_cameras CLIP.bvh > captured.bvh
#include <etude/capture.h>

#include <cstdio>
#include <fstream>
#include <iterator>
using namespace etude::engine;

int main(int count, char** names) try {
  if (count != 2) throw BadInput("two_cameras CLIP.bvh");
  std::ifstream file(names[1], std::ios::binary);
  const Motion truth = ReadMotion(std::string(std::istreambuf_iterator<char>(file), {}), names[1]);
  // The cameras stand in front and on the left, 4 m away. The columns of R_CW are the world's axes x, y, z in the
  // camera's frame.
  std::vector<NamedCamera> rig(2);
  rig[0].camera.R_CW = {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, rig[0].camera.p_WC = {0, 1, 4};
  rig[1].camera.R_CW = {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}, rig[1].camera.p_WC = {4, 1, 0};
  for (NamedCamera& each : rig) {  // calibrate each from 27 measured points of a box
    std::vector<PointPair> pairs;
    for (int i = 0; i < 27; ++i) pairs.push_back({{i % 3 - 1, i / 3 % 3, i / 9 - 1}, {}});
    for (PointPair& pair : pairs) pair.pixel = Project(each.camera, pair.world).value();
    each.camera = Calibrate(pairs, 640, 480).camera;
  }
  const int left[] = {4, 5, 6, 12, 13, 14};  // Role numbers of shoulder, elbow, wrist, hip, knee, ankle; right: + 4
  std::vector<SeenPeople> seen(rig.size(), SeenPeople(truth.poses.size(), {SeenPerson{}}));
  for (std::size_t c = 0; c < rig.size(); ++c) {
    for (std::size_t f = 0; f < truth.poses.size(); ++f) {
      const auto see = [&](Role role) { return Keypoint{Project(rig[c].camera, truth.poses[f][role]).value(), 1}; };
      seen[c][f][0][Landmark::kNose] = see(Role::kHead);
      for (int i = 0; i < 12; ++i) seen[c][f][0].keypoints[5 + i] = see(Role(left[i / 2] + i % 2 * 4));
    }
  }
  const std::optional<glm::dvec2> noses[] = {seen[0][0][0].keypoints[0].pixel, seen[1][0][0].keypoints[0].pixel};
  const TriangulatedPoint nose = Triangulate(rig, noses);
  std::fprintf(stderr, "off by %.2g m\n", glm::distance(nose.position, truth.poses[0][Role::kHead]));
  std::fputs(Capture(rig, seen, {.rate_hz = truth.rate_hz}).bvh.c_str(), stdout);
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 2;
}
