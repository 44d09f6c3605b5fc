// Simulates a Kinect and two cameras that watch a clip. two_sensors CLIP.bvh prints the Kinect's mean error and writes
// left.ppm and right.ppm, the middle of the clip, into the current folder.
#include <etude/sim/pictures.h>
#include <etude/sim/sensor.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
using namespace etude;

int main(int count, char** names) try {
  if (count != 2) throw engine::BadInput("two_sensors CLIP.bvh");
  std::ifstream file(names[1], std::ios::binary);
  const BodyMotion truth = engine::ReadMotion(std::string(std::istreambuf_iterator<char>(file), {}), names[1]);
  double squares = 0, tracked = 0, seen = 0;
  const SkeletonStream reports = sim::SenseSkeleton(truth, {.sensor = "v2", .seed = 7});
  for (std::size_t f = 0; f < reports.frames.size(); ++f) {
    for (std::size_t j = 0; j < kRoleCount; ++j, ++seen) {
      const SensedJoint& joint = reports.frames[f].joints[j];
      if (joint.state != TrackingState::kTracked) continue;
      squares += std::pow(glm::distance(joint.position, truth.poses[f].joints[j]), 2), ++tracked;
    }
  }
  std::printf("%zu frames, %.1f %% of the joints tracked, off by %.1f mm\n", reports.frames.size(),
              100 * tracked / seen, 1000 * std::sqrt(squares / tracked));
  const auto cameras = sim::StereoCameras(truth);
  const sim::Studio studio(truth, cameras, {.scene = 0.5});
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const sim::Picture picture = studio.Shoot(c, truth.poses.size() / 2);
    std::ofstream out(cameras[c].name + ".ppm", std::ios::binary);
    out << "P6 " << picture.colour.width << ' ' << picture.colour.height << " 255\n";
    for (const Rgb8& pixel : picture.colour.pixels) out << char(pixel.r) << char(pixel.g) << char(pixel.b);
    const auto shown = std::ranges::count(picture.person.pixels, 1);
    std::printf("%s: %td pixels of the person\n", cameras[c].name.c_str(), shown);
  }
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 2;
}
