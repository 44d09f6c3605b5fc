#include "sim/render/empty_room.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "sim/random/stream.h"
#include "sim/render/uniforms.h"

namespace etude {
namespace {

TilePattern MakePattern(RandomStream& random, double spot_share) {
  TilePattern pattern;
  for (glm::vec4& tile : pattern) {
    const double radius = random.Uniform(0.12, 0.34);
    const double x = random.Uniform(radius, 1 - radius);
    const double y = random.Uniform(radius, 1 - radius);
    const double tone = random.Uniform();
    const bool has_spot = random.Chance(spot_share);
    tile = {x, y, has_spot ? radius : 0.0, tone};
  }
  return pattern;
}

constexpr double kNextToLamp = 1e-3;

RoomTile MakeTile(const PixelRect& pixels, const LampView& view, int width) {
  RoomTile tile{.pixels = pixels};
  // Collect the tile's points and their directions.
  std::vector<glm::dvec3> points, directions;
  glm::dvec3 sum(0), low(1e9), high(-1e9);
  for (int y = pixels.top; y < pixels.bottom; ++y) {
    for (int x = pixels.left; x < pixels.right; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      const glm::dvec3 from_lamp(view.x[i], view.y[i], view.z[i]);
      const double distance = glm::length(from_lamp);
      tile.farthest = std::max(tile.farthest, distance);
      points.push_back(from_lamp);
      low = glm::min(low, from_lamp);
      high = glm::max(high, from_lamp);
      directions.push_back(from_lamp / std::max(distance, kNextToLamp));
      sum += directions.back();
    }
  }
  // Compute the bounding cone of the tile's directions.
  const double length = glm::length(sum);
  tile.middle = length > 0 ? sum / length : glm::dvec3(0, 1, 0);
  for (const glm::dvec3& direction : directions) {
    tile.spread = std::max(tile.spread, glm::distance(direction, tile.middle));
  }
  // Compute the bounding ball of the tile's points.
  tile.centre = 0.5 * (low + high);
  for (const glm::dvec3& point : points) tile.radius = std::max(tile.radius, glm::distance(point, tile.centre));
  return tile;
}

/// Computes the lamp's view of a picture. `depths` are in metres, infinite where there is no room.
LampView SeeFromLamp(const std::vector<float>& depths, const Camera& camera, const glm::dvec3& lamp) {
  const Intrinsics& in = camera.intrinsics;
  const glm::dmat3 R_WC = glm::transpose(camera.R_CW);
  LampView view;
  view.lamp = lamp;
  for (std::vector<float>* part : {&view.x, &view.y, &view.z}) part->reserve(depths.size());
  // Compute the position of every pixel's point relative to the lamp.
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      const double depth = depths[static_cast<std::size_t>(y) * in.width + x];
      const double v = (y + 0.5 - in.cy) / in.fy, u = (x + 0.5 - in.cx - in.skew * v) / in.fx;
      const glm::dvec3 point = std::isfinite(depth) ? camera.p_WC + depth * (R_WC * glm::dvec3(u, v, 1)) - lamp
                                                    : glm::dvec3(0, kNextToLamp, 0);
      view.x.push_back(static_cast<float>(point.x));
      view.y.push_back(static_cast<float>(point.y));
      view.z.push_back(static_cast<float>(point.z));
    }
  }
  // Make the tiles in which the room is visible.
  for (int top = 0; top < in.height; top += kRoomTileSize) {
    for (int left = 0; left < in.width; left += kRoomTileSize) {
      const PixelRect pixels{left, top, std::min(left + kRoomTileSize, in.width),
                             std::min(top + kRoomTileSize, in.height)};
      const RoomTile tile = MakeTile(pixels, view, in.width);
      if (tile.farthest > 2 * kNextToLamp) view.tiles.push_back(tile);
    }
  }
  return view;
}

// The number of cameras in the largest rig. A kept picture takes about 25 MB at 640 × 480, and 100 MB at 1280 × 960.
constexpr std::size_t kMaxKept = 8;

bool SameView(const Camera& a, const Camera& b) {
  const Intrinsics &i = a.intrinsics, &j = b.intrinsics;
  return i.width == j.width && i.height == j.height && i.fx == j.fx && i.fy == j.fy && i.cx == j.cx && i.cy == j.cy &&
         i.skew == j.skew && a.R_CW == b.R_CW && a.p_WC == b.p_WC;
}

bool SameInterior(const std::optional<Interior>& kept, const Interior* wanted) {
  return wanted == nullptr ? !kept : kept && *kept == *wanted;
}

void SetTiles(const GlFunctions& gl, GLuint program, std::uint64_t seed) {
  const RoomTexture pattern = MakeRoomTexture(seed);
  const auto set = [&](const char* name, const TilePattern& tiles) {
    gl.Uniform4fv(gl.GetUniformLocation(program, name), static_cast<GLsizei>(tiles.size()),
                  glm::value_ptr(tiles.front()));
  };
  set("floor_tiles", pattern.floor);
  set("wall_tiles", pattern.wall);
}

template <typename Pixel>
void Shape(int width, int height, bool wanted, Image<Pixel>& image) {
  if (!wanted) {
    image = {};
  } else if (image.width != width || image.height != height) {
    image = Image<Pixel>(width, height);
  }
}

}  // namespace

RoomTexture MakeRoomTexture(std::uint64_t seed) {
  const WorldKey key{seed, "room", 0};
  RandomStream floor(key, "floor-texture");
  RandomStream wall(key, "wall-texture");
  return {MakePattern(floor, 0.25), MakePattern(wall, 0.45)};
}

void RoundToBytes(const float* light, std::size_t count, float brightness, std::uint8_t* bytes) {
  // Adding 2²³ rounds a float to a whole number, because the sum has no bits left for fractions.
  constexpr float kWhole = 8388608;
  for (std::size_t i = 0; i < count; ++i) {
    const float level = std::min(std::max(light[i] * brightness, 0.0f), 1.0f) * 255.0f;
    const float whole = (level + kWhole) - kWhole;
    bytes[i] = static_cast<std::uint8_t>(static_cast<int>(whole));
  }
}

void FillBackdrop(const KeptRoom& room, int width, double brightness, Targets targets, const RowRange& rows,
                  View& view) {
  const int height = rows.end - rows.first;
  Shape(width, height, true, view.colour);
  Shape(width, height, targets != Targets::kColour, view.labels);
  Shape(width, height, targets == Targets::kAll, view.depth);
  const std::size_t first = static_cast<std::size_t>(width) * rows.first;
  const std::size_t count = static_cast<std::size_t>(width) * height;

  static_assert(sizeof(Rgb8) == 3, "a picture is written as bytes of its colours");
  RoundToBytes(&room.colours[3 * first], 3 * count, static_cast<float>(brightness),
               reinterpret_cast<std::uint8_t*>(view.colour.pixels.data()));
  if (targets != Targets::kColour) std::copy_n(&room.labels[first], count, view.labels.pixels.begin());
  if (targets == Targets::kAll) std::copy_n(&room.depths[first], count, view.depth.pixels.begin());
}

KeptRooms::~KeptRooms() {
  for (const Kept& kept : kept_) Drop(kept);
}

void KeptRooms::Drop(const Kept& kept) {
  gl_.DeleteTextures(1, &kept.picture.room);
  gl_.DeleteTextures(1, &kept.picture.extra);
}

const KeptRoom& KeptRooms::FindOrDraw(const Room& room, const Camera& camera) {
  // If a picture of this room and camera is kept, make it the most recently used one.
  const auto found = std::ranges::find_if(kept_, [&](const Kept& kept) {
    return kept.texture_seed == room.texture_seed && SameView(kept.camera, camera) &&
           SameInterior(kept.interior, room.interior);
  });
  if (found != kept_.end()) {
    std::rotate(kept_.begin(), found, found + 1);
    return kept_.front().picture;
  }
  // Otherwise drop the least recently used picture and draw a new picture.
  if (kept_.size() == kMaxKept) {
    Drop(kept_.back());
    kept_.pop_back();
  }
  const auto interior = room.interior != nullptr ? std::optional(*room.interior) : std::nullopt;
  kept_.push_front({room.texture_seed, interior, camera, Draw(room, camera)});
  return kept_.front().picture;
}

KeptRoom KeptRooms::Draw(const Room& room, const Camera& camera) {
  const int width = camera.intrinsics.width, height = camera.intrinsics.height;
  KeptRoom kept;
  // Attach two float textures to a framebuffer.
  GLuint framebuffer = 0;
  gl_.GenFramebuffers(1, &framebuffer);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  for (int i = 0; i < 2; ++i) {
    GLuint& texture = i == 0 ? kept.room : kept.extra;
    texture = MakeUnfilteredTexture(gl_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, texture, 0);
  }
  gl_.DrawBuffers(2, attachments);
  for (GLuint i = 0; i < 2; ++i)
    gl_.ColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);  // the last draw may have switched off some channels

  // Draw one triangle over the whole picture; the triangle's shader casts a ray for every pixel.
  gl_.Viewport(0, 0, width, height);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_SCISSOR_TEST);
  const GLuint program = room.interior != nullptr ? interior_program_ : studio_program_;
  gl_.UseProgram(program);
  SetPixelGeometry(gl_, program, camera, room);
  SetTiles(gl_, program, room.texture_seed);
  gl_.Uniform1f(gl_.GetUniformLocation(program, "pixel_angle"), static_cast<float>(1.0 / camera.intrinsics.fx));
  if (room.interior != nullptr) SetInterior(gl_, program, *room.interior);
  gl_.BindVertexArray(empty_vertices_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);

  // Read back the colours and depths, then the lamp's shares and the labels.
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  std::vector<float> four(4 * pixels);
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, four.data());
  CheckMemory(gl_);
  kept.colours.resize(3 * pixels);
  kept.depths.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::copy_n(&four[4 * i], 3, &kept.colours[3 * i]);
    kept.depths[i] = four[4 * i + 3];
  }
  gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
  gl_.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, four.data());
  CheckMemory(gl_);
  kept.lamp_shares.resize(3 * pixels);
  kept.labels.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::copy_n(&four[4 * i], 3, &kept.lamp_shares[3 * i]);
    kept.labels[i] = static_cast<std::uint8_t>(four[4 * i + 3]);
  }
  gl_.DeleteFramebuffers(1, &framebuffer);
  kept.lamp = SeeFromLamp(kept.depths, camera, LightsOf(room).key);
  return kept;
}

}  // namespace etude
