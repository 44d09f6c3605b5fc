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
  std::vector<Camera> rig(
      2);  // in front and on the left, 4 m away; columns: the world's x, y, z as the camera has them
  rig[0].R_CW = {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, rig[0].p_WC = {0, 1, 4};
  rig[1].R_CW = {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}, rig[1].p_WC = {4, 1, 0};
  for (Camera& camera : rig) {  // from 27 measured points of a box
    std::vector<PointPair> pairs;
    for (int i = 0; i < 27; ++i) pairs.push_back({{i % 3 - 1, i / 3 % 3, i / 9 - 1}, {}});
    for (PointPair& pair : pairs) pair.pixel = Project(camera, pair.p_WQ).value();
    camera = Calibrate(pairs, 640, 480).camera;
  }
  // COCO's keypoints: nose, eyes, ears, then shoulders, elbows, wrists, hips, knees, ankles, left before right.
  std::vector<SeenPeople> seen(rig.size(), SeenPeople(truth.poses.size(), {SeenPerson(17)}));
  const int left[] = {4, 5, 6, 12, 13, 14};  // roles; the right one is four further on
  for (std::size_t c = 0; c < rig.size(); ++c) {
    for (std::size_t f = 0; f < truth.poses.size(); ++f) {
      const auto see = [&](Role role) { return Keypoint{Project(rig[c], truth.poses[f][role]).value(), 1}; };
      seen[c][f][0][0] = see(Role::kHead);
      for (int i = 0; i < 12; ++i) seen[c][f][0][5 + i] = see(Role(left[i / 2] + i % 2 * 4));
    }
  }
  const std::optional<glm::dvec2> noses[] = {seen[0][0][0][0].pixel, seen[1][0][0][0].pixel};
  const auto nose = Triangulate(rig, noses).value();
  std::fprintf(stderr, "off by %.2g m\n", glm::distance(nose.p_WQ, truth.poses[0][Role::kHead]));
  std::fputs(Capture(rig, seen, {.rate_hz = truth.rate_hz}).bvh.c_str(), stdout);
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 2;
}
