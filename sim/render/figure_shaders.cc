#include "sim/render/shaders.h"

namespace etude {
namespace {

constexpr const char* kBodyPlace = R"glsl(
void main() { Place(BoxCorner()); }
)glsl";

constexpr const char* kBody = R"glsl(
flat in vec4 capsule_start;
flat in vec4 capsule_end;
flat in vec4 paint;
flat in vec3 front;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;
layout(location = 2) out float depth;

// Returns the depth at which `ray` enters the capsule, or infinity. The ray's start is first moved next to the capsule,
// because far away the difference of squares would lose most of a float's digits.
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

  // Intersect the infinite cylinder first; beyond its ends, intersect the half-sphere of that end.
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

)glsl";

constexpr const char* kPlainCapsule = R"glsl(
vec3 SkinPaint(vec3 point) { return paint.rgb; }
)glsl";

constexpr const char* kFace = R"glsl(
// Paints hair, eyes and a smile, so that a viewer sees the direction of the face.
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

vec3 SkinPaint(vec3 point) { return FacePaint(paint.rgb, point); }
)glsl";

constexpr const char* kBodyMain = R"glsl(
void main() {
  vec3 ray = PixelRay();
  depth = MeetCapsule(ray);
  if (!(depth > 0.0 && depth < farthest) || IsBehindRoom(depth)) discard;
  vec3 point = depth * ray;
  vec3 normal = Normal(point);

  colour = LitPaint(SkinPaint(point), normal, point, ray);
  label = uint(capsule_end.w);
  gl_FragDepth = depth / farthest;
}
)glsl";

constexpr const char* kCorner = R"glsl(
in vec3 place_in;   // in E
in vec3 normal_in;
in vec4 paint_in;   // rgb; a = label
in vec4 rest_in;    // position on the body at rest; a = index of its paint, or -1

uniform mat3 image_of_direction;  // E -> (u w, v w, w)
uniform vec2 image_size;

out vec3 normal;
out vec3 rest;
flat out vec4 paint;
flat out int pattern;

// `point` is homogeneous in E. Row 0 of the framebuffer is the picture's top row, so nothing is flipped. Every pixel
// writes its depth for hidden surfaces; z only clips what is nearer than 1 cm or beyond infinity.
void Place(vec4 point) {
  vec3 image = image_of_direction * point.xyz;
  gl_Position = vec4(2.0 * image.xy / image_size - image.z, image.z - 0.02 * point.w, image.z);
  normal = normal_in;
  paint = paint_in;
  rest = rest_in.xyz;
  pattern = int(rest_in.w);
}
)glsl";

constexpr const char* kPlace = R"glsl(
void main() { Place(vec4(place_in, 1.0)); }
)glsl";

// Projects a point from the lamp onto a plane: the point's coordinates are divided by `fall`, the point's distance from
// the lamp towards the plane. The homogeneous w does this division, so triangles stay flat, interpolation is exact, and
// points above the lamp lie beyond infinity.
constexpr const char* kShadowPlace = R"glsl(
uniform vec3 eye;
uniform vec3 lamp;
uniform float wall_z;
uniform bool onto_wall;

out vec3 caster;  // in E: the point that casts the shadow

void main() {
  vec3 lamp_E = lamp - eye, from_lamp = place_in - lamp_E;
  float reach = onto_wall ? lamp.z - wall_z : lamp.y;
  float fall = onto_wall ? -from_lamp.z : -from_lamp.y;
  vec3 thrown = lamp_E * fall + from_lamp * reach;
  Place(vec4(thrown, fall));
  caster = place_in;
  gl_ClipDistance[0] = reach - fall;  // clips points behind the plane
  // Pixels behind the wall or under the floor are discarded later; this clips nearly all of them.
  vec3 place = thrown + eye * fall;
  gl_ClipDistance[1] = (onto_wall ? place.y : place.z - wall_z * fall) + 0.01 * fall;
}
)glsl";

constexpr const char* kSurface = R"glsl(
in vec3 normal;
in vec3 rest;
flat in vec4 paint;
flat in int pattern;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;
layout(location = 2) out float depth;

)glsl";

constexpr const char* kPlainSkin = R"glsl(
vec3 SkinPaint() { return paint.rgb; }
)glsl";

constexpr const char* kPaintedSkin = R"glsl(
uniform float pixel_angle;
vec3 SkinPaint() { return Painted(pattern, rest, depth * pixel_angle); }
)glsl";

constexpr const char* kTexturedSkin = R"glsl(
uniform sampler2D skin;
vec3 SkinPaint() { return texture(skin, rest.xy).rgb; }
)glsl";

constexpr const char* kSurfaceMain = R"glsl(
void main() {
  vec3 ray = PixelRay();
  depth = 1.0 / gl_FragCoord.w;
  if (!(depth < farthest) || IsBehindRoom(depth)) discard;
  // Open surfaces show their back side, too. The picture is drawn upside down, so GL takes back sides for front sides.
  vec3 outward = gl_FrontFacing ? -normal : normal;
  colour = LitPaint(SkinPaint(), outward / max(length(normal), 1e-6), depth * ray, ray);
  label = uint(paint.a);
  gl_FragDepth = depth / farthest;
}
)glsl";

constexpr const char* kShadow = R"glsl(
uniform bool onto_wall;

in vec3 normal;
in vec3 caster;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;

void main() {
  vec3 ray = PixelRay();
  RoomHit hit = MeetRoom(ray);
  if (hit.is_wall != onto_wall || hit.depth == kInfinity) discard;
  vec3 point = hit.depth * ray;
  // The shadow of a surface is that of a ball with the same normal: softer where the surface turns away from the lamp,
  // i.e. at the body's outline. It is less soft than that of capsules, because otherwise each ear and cheek would show
  // in the soft edge of the head.
  float slant = dot(normal, normalize(lamp - eye - caster)) / max(length(normal), 1e-6);
  float inside = 1.0 - sqrt(max(1.0 - slant * slant, 0.0));
  colour = RoomInShadow(hit, point, inside, clamp(0.04 * distance(point, caster), 0.03, 0.12));
  label = 1u;
}
)glsl";

constexpr const char* kShadowMark = R"glsl(
layout(location = 0) out vec4 colour;
void main() { colour = vec4(0.0, 0.0, 0.0, 0.5); }
)glsl";

}  // namespace

std::string CapsuleVertexShader() { return AssembleShader({kCapsuleBox, kBodyPlace}); }
std::string CapsuleFragmentShader(bool with_face) {
  return AssembleShader({kRoomGeometry, kBodyLight, kRoomInFront, kBody, with_face ? kFace : kPlainCapsule, kBodyMain});
}

std::string SurfaceVertexShader() { return AssembleShader({kCorner, kPlace}); }
std::string SurfaceFragmentShader(Skin skin) {
  if (skin != Skin::kPaint) {
    const char* const paint = skin == Skin::kColour ? kPlainSkin : kTexturedSkin;
    return AssembleShader({kRoomGeometry, kBodyLight, kRoomInFront, kSurface, paint, kSurfaceMain});
  }
  return AssembleShader({kRoomGeometry, kBodyLight, kRoomInFront, kPaintPatterns, kNoRoomPatterns, kPainted, kSurface,
                         kPaintedSkin, kSurfaceMain});
}
std::string SurfaceShadowVertexShader() { return AssembleShader({kCorner, kShadowPlace}); }
std::string SurfaceShadowFragmentShader() { return AssembleShader({kRoomGeometry, kShadowLight, kShadow}); }
std::string ShadowMarkFragmentShader() { return AssembleShader({kShadowMark}); }

}  // namespace etude
