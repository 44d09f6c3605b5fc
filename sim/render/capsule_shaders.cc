#include "sim/render/shader_pieces.h"
#include "sim/render/shaders.h"

namespace etude {
namespace {

// One instance per capsule; its box is a strip of 14 corners.
constexpr const char* kBox = R"glsl(
in vec4 start_and_radius;  // in E
in vec4 end_and_label;
in vec4 paint_in;          // rgb; a = 1 for a head with a face
in vec3 front_in;          // where the face looks

uniform mat3 image_of_direction;  // E -> (u w, v w, w)
uniform vec2 image_size;
uniform float reach;  // beyond the capsule's skin; 0 of all but contacts

flat out vec4 capsule_start;
flat out vec4 capsule_end;
flat out vec4 paint;
flat out vec3 front;

vec3 BoxCorner() {
  vec3 start = start_and_radius.xyz, end = end_and_label.xyz;
  float radius = 1.01 * start_and_radius.w + reach;
  float span = distance(start, end);
  vec3 along = span > 0.0 ? (end - start) / span : vec3(0.0, 1.0, 0.0);
  vec3 across = normalize(cross(along, abs(along.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 third = cross(along, across);
  int bit = 1 << gl_VertexID;
  vec3 side = vec3((0x287a & bit) != 0, (0x02af & bit) != 0, (0x31e3 & bit) != 0) * 2.0 - 1.0;
  return 0.5 * (start + end) + along * side.x * (0.5 * span + radius) + (across * side.y + third * side.z) * radius;
}

void Place(vec3 point) {
  vec3 image = image_of_direction * point;
  // Row 0 of the framebuffer is the picture's top row, so nothing needs to be flipped. Depth is
  // written per pixel; z = 0 keeps near boxes from being cut.
  gl_Position = vec4(2.0 * image.xy / image_size - image.z, 0.0, image.z);
  capsule_start = start_and_radius;
  capsule_end = end_and_label;
  paint = paint_in;
  front = front_in;
}
)glsl";

constexpr const char* kBodyPlace = R"glsl(
void main() { Place(BoxCorner()); }
)glsl";

constexpr const char* kShadowPlace = R"glsl(
uniform vec3 eye;
uniform vec3 lamp;
uniform float wall_z;
uniform bool onto_wall;

void main() {
  vec3 lamp_E = lamp - eye;
  vec3 from_lamp = BoxCorner() - lamp_E;
  float drop = onto_wall ? lamp.z - wall_z : lamp.y;
  // A corner level with the lamp would throw its shadow to infinity: far is enough.
  float fall = max(onto_wall ? -from_lamp.z : -from_lamp.y, 0.05);
  Place(lamp_E + from_lamp * (drop / fall));
}
)glsl";

constexpr const char* kBody = R"glsl(
uniform float farthest;

flat in vec4 capsule_start;
flat in vec4 capsule_end;
flat in vec4 paint;
flat in vec3 front;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;
layout(location = 2) out float depth;

// The depth at which `ray` enters the capsule, or infinity. The ray's start is moved next to the
// capsule first: far away, the difference of squares would lose most of a float's digits.
float MeetCapsule(vec3 ray) {
  vec3 start = capsule_start.xyz, along = capsule_end.xyz - start;
  float radius = capsule_start.w;
  float square = dot(ray, ray);
  float shift = dot(start + 0.5 * along, ray) / square;
  vec3 origin = shift * ray - start;

  float along_along = dot(along, along), along_ray = dot(along, ray), along_origin = dot(along, origin);
  float a = along_along * square - along_ray * along_ray;
  float b = along_along * dot(origin, ray) - along_origin * along_ray;
  float c = along_along * (dot(origin, origin) - radius * radius) - along_origin * along_origin;
  float h = b * b - a * c;
  if (along_along > 0.0 && h < 0.0) return kInfinity;

  // First the endless cylinder; beyond its ends, the half-sphere of that end.
  float cylinder = -(b + sqrt(max(h, 0.0))) / max(a, 1e-20);
  float share = along_origin + cylinder * along_ray;
  if (along_along > 0.0 && share > 0.0 && share < along_along) return shift + cylinder;
  vec3 from_end = share <= 0.0 ? origin : origin - along;
  b = dot(from_end, ray);
  h = b * b - square * (dot(from_end, from_end) - radius * radius);
  return h < 0.0 ? kInfinity : shift - (b + sqrt(h)) / square;
}

vec3 Normal(vec3 point) {
  vec3 along = capsule_end.xyz - capsule_start.xyz, from_start = point - capsule_start.xyz;
  float share = clamp(dot(from_start, along) / max(dot(along, along), 1e-20), 0.0, 1.0);
  return (from_start - share * along) / capsule_start.w;
}

// Hair, eyes and a smile, so that one sees where the person looks.
vec3 FacePaint(vec3 skin, vec3 point) {
  vec3 middle = 0.5 * (capsule_start.xyz + capsule_end.xyz);
  vec3 upward = capsule_end.xyz - capsule_start.xyz;
  float height = length(upward);
  upward = height > 0.0 ? upward / height : vec3(0.0, 1.0, 0.0);
  vec3 forward = front - dot(front, upward) * upward;
  forward /= max(length(forward), 1e-6);
  vec3 place = (point - middle) / capsule_start.w;
  vec3 face = vec3(dot(place, cross(upward, forward)), dot(place, upward), dot(place, forward));

  if (face.y - 0.75 * face.z > 0.25) return vec3(0.26, 0.13, 0.08);
  if (face.z < 0.0) return skin;
  if (length(vec2(abs(face.x) - 0.36, 0.7 * (face.y - 0.05))) < 0.11) return vec3(0.16, 0.08, 0.06);
  float smile = abs(length(vec2(face.x, face.y + 0.22)) - 0.34);
  if (smile < 0.05 && face.y < -0.40) return vec3(0.62, 0.20, 0.18);
  return skin;
}

void main() {
  vec3 ray = PixelRay();
  depth = MeetCapsule(ray);
  if (!(depth > 0.0 && depth < farthest)) discard;
  vec3 point = depth * ray;
  vec3 normal = Normal(point);

  vec3 skin = paint.rgb;
  if (paint.a > 0.5) skin = FacePaint(skin, point);
  colour = LitPaint(skin, normal, point, ray);
  label = uint(capsule_end.w);
  gl_FragDepth = depth / farthest;
}
)glsl";

constexpr const char* kShadow = R"glsl(
uniform bool onto_wall;

flat in vec4 capsule_start;
flat in vec4 capsule_end;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;

void main() {
  vec3 ray = PixelRay();
  RoomHit hit = MeetRoom(ray);
  if (hit.is_wall != onto_wall || hit.depth == kInfinity) discard;
  vec3 point = hit.depth * ray, lamp_E = lamp - eye;
  float gap = sqrt(SquaredDistance(point, lamp_E, capsule_start.xyz, capsule_end.xyz));
  float inside = 1.0 - gap / capsule_start.w;
  if (inside <= 0.0) discard;

  // Softer the farther the shadow falls.
  float softness = clamp(0.2 * distance(point, capsule_start.xyz), 0.15, 0.6);
  colour = RoomInShadow(hit, point, inside, softness);
  label = 1u;
}
)glsl";

// The floor under a shoe sees little of the light that comes from all sides.
constexpr const char* kContact = R"glsl(
uniform sampler2D kept_room;
uniform sampler2D kept_extra;
uniform float brightness;
uniform float reach;

flat in vec4 capsule_start;
flat in vec4 capsule_end;

layout(location = 0) out vec4 colour;

void main() {
  vec4 room = texelFetch(kept_room, ivec2(gl_FragCoord.xy), 0);
  if (room.a == kInfinity) discard;
  vec3 point = room.a * PixelRay();
  vec3 along = capsule_end.xyz - capsule_start.xyz;
  float share = clamp(dot(point - capsule_start.xyz, along) / max(dot(along, along), 1e-9), 0.0, 1.0);
  float gap = distance(point, capsule_start.xyz + share * along) - capsule_start.w;
  if (gap >= reach) discard;
  float near = 1.0 - max(gap, 0.0) / reach;
  vec3 lamps = texelFetch(kept_extra, ivec2(gl_FragCoord.xy), 0).rgb;
  colour = vec4(room.rgb * brightness * (1.0 - near * near * near * (0.55 - 0.3 * lamps)), 1.0);
}
)glsl";

}  // namespace

std::string ContactVertexShader() { return AssembleShader({kBox, kBodyPlace}); }
std::string ContactFragmentShader() { return AssembleShader({kRoomGeometry, kContact}); }
std::string CapsuleVertexShader() { return AssembleShader({kBox, kBodyPlace}); }
std::string CapsuleFragmentShader() { return AssembleShader({kRoomGeometry, kBodyLight, kBody}); }
std::string CapsuleShadowVertexShader() { return AssembleShader({kBox, kShadowPlace}); }
std::string CapsuleShadowFragmentShader() {
  return AssembleShader({kRoomGeometry, kShadowLight, kSegmentDistance, kShadow});
}

}  // namespace etude
