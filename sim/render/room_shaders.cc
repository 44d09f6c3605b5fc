#include "sim/render/shaders.h"

namespace etude {
namespace {

constexpr const char* kFullScreen = R"glsl(
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)glsl";

constexpr const char* kRoomPaint = R"glsl(
uniform float pixel_angle;  // the width of a pixel at depth 1

layout(location = 0) out vec4 room;   // rgb, depth
layout(location = 1) out vec4 extra;  // rgb = the lamp's share of the light; a = label

void main() {
  vec3 ray = PixelRay();
  RoomHit hit = MeetRoom(ray);
  if (hit.depth == kInfinity) {
    room = vec4(0.30, 0.40, 0.50, kInfinity);
    extra = vec4(0.0);
    return;
  }
  vec3 point = eye + hit.depth * ray;
  vec2 light = RoomLight(point, RoomNormal(hit.is_wall));
  float blur = 0.7 * hit.depth * pixel_angle;
  vec3 paint = StudioPaint(hit.is_wall ? point.xy : point.xz, hit.is_wall, blur);
  // Paint a skirting board at the bottom of the wall.
  if (hit.is_wall) paint *= 1.0 - 0.35 * (1.0 - smoothstep(-blur, blur, point.y - 0.09));
  room = vec4(paint * (light.x + light.y), hit.depth);
  extra = vec4(vec3(light.y / (light.x + light.y)), 0.0);
}
)glsl";

// Intersects rays with the closed room and its boxes, in E.
constexpr const char* kInteriorGeometry = R"glsl(
uniform vec3 room_low;   // in the world
uniform vec3 room_high;
uniform int boxes;
uniform vec4 box_centre[48];  // in the world; a = sine of its heading
uniform vec4 box_half[48];    // a = cosine of its heading

const int kFloor = 0, kCeiling = 1, kBack = 2, kFront = 3, kLeft = 4, kRight = 5, kBox = 6;

struct Hit {
  float depth;
  int surface;  // kFloor … kRight; a box has kBox + its index
  vec3 normal;
};

void MeetPlane(inout Hit hit, float from_eye, float along, int surface, vec3 normal) {
  // A wall is visible from inside only: eye and ray must be on opposite sides of it.
  if (from_eye * dot(normal, vec3(1.0)) >= 0.0 || from_eye * along <= 0.0) return;
  float depth = from_eye / along;
  if (depth < hit.depth) hit = Hit(depth, surface, normal);
}

vec3 InBox(vec3 v, vec4 centre, vec4 half_size) {
  return vec3(half_size.w * v.x - centre.w * v.z, v.y, centre.w * v.x + half_size.w * v.z);
}

// The depths at which a ray enters and leaves the box; it misses the box if it leaves before it enters.
vec2 BoxSpan(int i, vec3 origin, vec3 ray, out vec3 near) {
  vec3 from = InBox(origin - box_centre[i].xyz, box_centre[i], box_half[i]);
  vec3 along = InBox(ray, box_centre[i], box_half[i]);
  along = mix(along, vec3(1e-7), lessThan(abs(along), vec3(1e-7)));
  vec3 middle = -from / along, reach = box_half[i].xyz / abs(along);
  near = middle - reach;
  vec3 far = middle + reach;
  return vec2(max(max(near.x, near.y), near.z), min(min(far.x, far.y), far.z));
}

Hit MeetInterior(vec3 ray) {
  Hit hit = Hit(kInfinity, kFloor, vec3(0.0, 1.0, 0.0));
  MeetPlane(hit, room_low.y - eye.y, ray.y, kFloor, vec3(0.0, 1.0, 0.0));
  MeetPlane(hit, room_high.y - eye.y, ray.y, kCeiling, vec3(0.0, -1.0, 0.0));
  MeetPlane(hit, room_low.z - eye.z, ray.z, kBack, vec3(0.0, 0.0, 1.0));
  MeetPlane(hit, room_high.z - eye.z, ray.z, kFront, vec3(0.0, 0.0, -1.0));
  MeetPlane(hit, room_low.x - eye.x, ray.x, kLeft, vec3(1.0, 0.0, 0.0));
  MeetPlane(hit, room_high.x - eye.x, ray.x, kRight, vec3(-1.0, 0.0, 0.0));
  for (int i = 0; i < boxes; ++i) {
    vec3 near;
    vec2 span = BoxSpan(i, eye, ray, near);
    if (span.x <= 0.0 || span.x > span.y || span.x >= hit.depth) continue;
    vec3 along = InBox(ray, box_centre[i], box_half[i]);
    vec3 own = span.x == near.x ? vec3(-sign(along.x), 0.0, 0.0)
               : span.x == near.y ? vec3(0.0, -sign(along.y), 0.0) : vec3(0.0, 0.0, -sign(along.z));
    float sine = box_centre[i].w, cosine = box_half[i].w;
    hit = Hit(span.x, kBox + i, vec3(cosine * own.x + sine * own.z, own.y, cosine * own.z - sine * own.x));
  }
  return hit;
}
)glsl";

constexpr const char* kInteriorPaint = R"glsl(
uniform float pixel_angle;  // the width of a pixel at depth 1
uniform float studio;
uniform vec3 skirting;
uniform vec4 rug;           // x and z of the centre, half sizes along x and z
uniform int pictures;
uniform vec4 picture_place[8];  // centre along the wall and above the floor, half sizes
uniform vec4 picture_frame[8];  // rgb; a = wall + 8 * glow
uniform vec3 key_colour;
uniform vec3 ambient_colour;
uniform vec3 fill_direction;
uniform vec3 fill_colour;
uniform vec3 window;        // centre of the window in the world
uniform vec3 window_colour;

layout(location = 0) out vec4 room;   // rgb, depth
layout(location = 1) out vec4 extra;  // rgb = the lamp's share of the light; a = label

// Paint indices: 0 floor, 1 wall, 2 ceiling, 3 rug, 4… pictures, 12… boxes.
vec3 SurfacePaint(Hit hit, vec3 point, float blur, out float glow) {
  glow = 0.0;
  if (hit.surface >= kBox) {
    int i = hit.surface - kBox;
    vec3 local = InBox(point - box_centre[i].xyz, box_centre[i], box_half[i]);
    vec3 own = InBox(hit.normal, box_centre[i], box_half[i]);
    // Vertical faces are painted along the floor and upwards, top faces as seen from above.
    vec3 place = abs(own.y) > 0.5 ? vec3(local.x, local.z, 0.0) : abs(own.x) > 0.5 ? vec3(local.z, local.y, 0.0)
                                                                              : vec3(local.x, local.y, 1.0);
    return Painted(12 + i, place + vec3(0.0, 0.0, 0.003), blur);
  }
  if (hit.surface == kCeiling) return Painted(2, vec3(point.xz, 0.0), blur);
  if (hit.surface == kFloor) {
    vec3 paint = Painted(0, vec3(point.x, point.z, 0.0), blur);
    if (studio > 0.0) paint = mix(paint, StudioPaint(point.xz, false, blur), studio);
    vec2 inside = rug.zw - abs(point.xz - rug.xy);
    float within = min(inside.x, inside.y);
    if (rug.z > 0.0 && within > -blur) {
      vec3 pile = Painted(3, vec3(point.x, point.z, 0.0), blur) * (within < 0.06 ? 0.8 : 1.0);
      paint = mix(paint, pile, smoothstep(-blur, blur, within));
    }
    return paint;
  }
  vec2 place = hit.surface == kBack || hit.surface == kFront ? point.xy : point.zy;
  vec3 paint = Painted(1, vec3(place, 0.0), blur);
  if (studio > 0.0) paint = mix(paint, StudioPaint(place, true, blur), studio);
  paint = mix(paint, skirting, (1.0 - studio) * (1.0 - smoothstep(-blur, blur, place.y - 0.09)));
  for (int i = 0; i < pictures; ++i) {
    int wall = int(picture_frame[i].a) & 7;
    if (wall != hit.surface) continue;
    vec2 from_middle = place - picture_place[i].xy, inside = picture_place[i].zw - abs(from_middle);
    float within = min(inside.x, inside.y);
    if (within < -blur) continue;
    float lit = floor(picture_frame[i].a / 8.0) / 16.0;
    vec3 shown = Painted(4 + i, vec3(from_middle, 1.0), blur);
    // Draw a cross of bars in a window.
    float bar = lit > 0.0 ? min(abs(from_middle.x), abs(from_middle.y)) - 0.02 : 1.0;
    float frame = max(1.0 - smoothstep(0.04 - blur, 0.04 + blur, within), 1.0 - smoothstep(-blur, blur, bar));
    shown = mix(shown, picture_frame[i].rgb, frame);
    float cover = smoothstep(-blur, blur, within);
    paint = mix(paint, shown, cover);
    glow = mix(glow, lit * (1.0 - frame), cover);
  }
  return paint;
}

// The remaining share of the lamp's light: 0 deep in the shadow of a box.
float LampLeft(int own, vec3 point, vec3 normal, vec3 to_lamp) {
  float left = 1.0, distance_to_lamp = length(to_lamp);
  vec3 ray = to_lamp / distance_to_lamp;
  for (int i = 0; i < boxes; ++i) {
    vec3 near;
    vec2 span = BoxSpan(i, point + 0.002 * normal, ray, near);
    float inside = min(span.y, distance_to_lamp) - max(span.x, 0.0);
    if (inside <= 0.0) continue;
    // The lamp has a size: the farther a shadow falls, the softer it is.
    float softness = 0.01 + 0.05 * max(span.x, 0.0);
    left = min(left, 1.0 - smoothstep(0.0, softness, inside));
  }
  return left;
}

// Returns the ambient occlusion: nearby boxes and walls take away light that comes from all sides.
float Openness(int own, vec3 point, vec3 normal) {
  float open = 1.0;
  for (int i = 0; i < boxes; ++i) {
    if (i == own) continue;
    vec3 local = InBox(point - box_centre[i].xyz, box_centre[i], box_half[i]);
    vec3 away = abs(local) - box_half[i].xyz;
    float gap = length(max(away, 0.0));
    open *= 1.0 - 0.42 * exp(-gap / 0.09);
  }
  vec3 to_low = point - room_low, to_high = room_high - point;
  vec3 gap = mix(min(to_low, to_high), vec3(9.0), greaterThan(abs(normal), vec3(0.5)));
  return open * (1.0 - 0.18 * exp(-min(min(gap.x, gap.y), gap.z) / 0.25));
}

void main() {
  vec3 ray = PixelRay();
  Hit hit = MeetInterior(ray);
  if (hit.depth == kInfinity) {
    room = vec4(0.30, 0.40, 0.50, kInfinity);
    extra = vec4(0.0);
    return;
  }
  vec3 point = eye + hit.depth * ray;
  int own = hit.surface >= kBox ? hit.surface - kBox : -1;
  float blur = 0.7 * hit.depth * pixel_angle / max(abs(dot(hit.normal, normalize(ray))), 0.25);
  float glow;
  vec3 paint = SurfacePaint(hit, point, blur, glow);

  vec2 light = RoomLight(point, hit.normal);
  vec3 key = light.y * LampLeft(own, point, hit.normal, lamp - point) * key_colour;
  vec3 rest = light.x * Openness(own, point, hit.normal) * ambient_colour;
  rest += max(dot(hit.normal, fill_direction), 0.0) * fill_colour;
  vec3 to_window = window - point;
  float square = dot(to_window, to_window);
  rest += max(dot(hit.normal, to_window), 0.0) * inversesqrt(square) * 6.0 / (3.0 + square) * window_colour;
  vec3 all = mix(key + rest, vec3(1.0), glow);
  room = vec4(paint * all, hit.depth);
  extra = vec4((1.0 - glow) * key / max(all, vec3(1e-6)), own >= 0 ? 16.0 : 0.0);
}
)glsl";

}  // namespace

std::string FullScreenVertexShader() { return AssembleShader({kFullScreen}); }
std::string RoomFragmentShader() { return AssembleShader({kRoomGeometry, kStudioPaint, kRoomPaint}); }

std::string InteriorFragmentShader() {
  return AssembleShader(
      {kRoomGeometry, kStudioPaint, kPaintPatterns, kRoomPatterns, kPainted, kInteriorGeometry, kInteriorPaint});
}

}  // namespace etude
