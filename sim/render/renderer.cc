#include "sim/render/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>

#include "sim/render/capsule_shadows.h"
#include "sim/render/empty_room.h"
#include "sim/render/figure_batches.h"
#include "sim/render/gl_objects.h"
#include "sim/render/shaders.h"
#include "sim/render/touched_pixels.h"
#include "sim/render/uniforms.h"

namespace etude {
namespace {

// Surfaces beyond this distance are not drawn, metres.
constexpr float kMaxDepth = 200;

// The number of corners of the triangle strip that forms a box.
constexpr GLsizei kStripLength = 14;

struct Programs {
  GLuint studio = 0;
  GLuint interior = 0;
  GLuint capsule = 0;
  GLuint face = 0;     // program for capsules with a face
  GLuint surface = 0;  // program for surfaces in plain colours
  GLuint painted = 0;
  GLuint textured = 0;
  GLuint surface_shadow = 0;
  GLuint shadow_mark = 0;
};

Result<Programs> LinkAll(const GlContext& context) {
  const std::vector<std::string> capsule{"start_and_radius", "end_and_label", "paint_in", "front_in"};
  const std::vector<std::string> corner{"place_in", "normal_in", "paint_in", "rest_in"};
  Programs programs;
  const struct {
    GLuint& out;
    std::string vertex, fragment;
    std::vector<std::string> attributes;
  } wanted[] = {
      {programs.studio, FullScreenVertexShader(), RoomFragmentShader(), {}},
      {programs.interior, FullScreenVertexShader(), InteriorFragmentShader(), {}},
      {programs.capsule, CapsuleVertexShader(), CapsuleFragmentShader(false), capsule},
      {programs.face, CapsuleVertexShader(), CapsuleFragmentShader(true), capsule},
      {programs.surface, SurfaceVertexShader(), SurfaceFragmentShader(Skin::kColour), corner},
      {programs.painted, SurfaceVertexShader(), SurfaceFragmentShader(Skin::kPaint), corner},
      {programs.textured, SurfaceVertexShader(), SurfaceFragmentShader(Skin::kTexture), corner},
      {programs.surface_shadow, SurfaceShadowVertexShader(), SurfaceShadowFragmentShader(), corner},
      {programs.shadow_mark, SurfaceShadowVertexShader(), ShadowMarkFragmentShader(), corner},
  };
  for (const auto& want : wanted) {
    ASSIGN_OR_RETURN(const auto program, context.LinkProgram(want.vertex, want.fragment, want.attributes));
    want.out = program;
  }
  return programs;
}

GLuint MakeVertexArray(const GlFunctions& gl) {
  GLuint vertices = 0;
  gl.GenVertexArrays(1, &vertices);
  return vertices;
}

VertexStream CapsuleStream(const GlFunctions& gl) {
  return {gl,
          sizeof(CapsuleInstance),
          kStripLength,
          {{4, offsetof(CapsuleInstance, start_and_radius)},
           {4, offsetof(CapsuleInstance, end_and_label)},
           {4, offsetof(CapsuleInstance, paint)},
           {3, offsetof(CapsuleInstance, front)}}};
}

VertexStream CornerStream(const GlFunctions& gl) {
  return {gl,
          sizeof(SurfaceCorner),
          0,
          {{3, offsetof(SurfaceCorner, place)},
           {3, offsetof(SurfaceCorner, normal)},
           {4, offsetof(SurfaceCorner, paint_and_label)},
           {4, offsetof(SurfaceCorner, rest_and_paint)}}};
}

bool AllClosed(const std::vector<Figure>& figures) {
  return std::ranges::all_of(figures, [](const Figure& figure) {
    return std::ranges::all_of(figure.surfaces, [](const Surface& surface) { return surface.is_closed; });
  });
}

}  // namespace

struct Renderer::State {
  State(std::unique_ptr<GlContext> made, const Programs& linked)
      : context(std::move(made)),
        gl(context->functions()),
        programs(linked),
        empty_vertices(MakeVertexArray(gl)),
        capsules(CapsuleStream(gl)),
        faces(CapsuleStream(gl)),
        surfaces(CornerStream(gl)),
        painted(CornerStream(gl)),
        textured(CornerStream(gl)),
        textures(gl),
        targets(gl),
        rooms(gl, linked.studio, linked.interior, empty_vertices) {
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.CullFace(GL_FRONT);  // cull front faces: a camera inside a box sees only the back faces
    gl.BlendEquation(GL_MIN);
  }

  // The settings for drawing one picture.
  struct Shot {
    const Room& room;
    const Camera& camera;
    const std::vector<PixelRect>& rects;
    bool labels, depth;
  };

  void Use(GLuint program, const Shot& shot) {
    gl.UseProgram(program);
    SetNumber(program, "brightness", shot.room.brightness);
    SetNumber(program, "farthest", kMaxDepth);
  }

  void SetNumber(GLuint program, const char* name, double value) {
    gl.Uniform1f(gl.GetUniformLocation(program, name), static_cast<float>(value));
  }

  void Begin(const KeptRoom& room, const Camera& camera, Targets asked) {
    targets.Begin(camera.intrinsics.width, camera.intrinsics.height, asked);
    gl.BindTexture(GL_TEXTURE_2D, room.room);
  }

  // Draws the shadows of surfaces in the studio. Each triangle darkens the room separately; where shadows overlap, the
  // darkest counts.
  void DrawShadowsOfSurfaces(const Shot& shot) {
    const GLuint program = programs.surface_shadow;
    Use(program, shot);
    SetPixelGeometry(gl, program, shot.camera, shot.room);
    targets.WriteOnly(true, shot.labels, false);
    gl.Enablei(GL_BLEND, 0);
    for (const GLenum plane : {GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1}) gl.Enable(plane);
    for (const int onto_wall : {0, 1}) {
      gl.Uniform1i(gl.GetUniformLocation(program, "onto_wall"), onto_wall);
      for (const VertexStream* stream : {&surfaces, &painted, &textured}) {
        if (!stream->IsEmpty()) stream->Draw();
      }
    }
    for (const GLenum plane : {GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1}) gl.Disable(plane);
    gl.Disablei(GL_BLEND, 0);
  }

  // Marks shadows on the studio's floor only. Bodies are drawn over the shadows later.
  void MarkShadowsOfSurfaces(const Room& room, const Camera& camera) {
    gl.UseProgram(programs.shadow_mark);
    SetPixelGeometry(gl, programs.shadow_mark, camera, room);
    for (const GLenum plane : {GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1}) gl.Enable(plane);
    if (all_closed) gl.Enable(GL_CULL_FACE);  // for closed surfaces, the half that faces the lamp is enough
    for (const VertexStream* stream : {&surfaces, &painted, &textured}) {
      if (!stream->IsEmpty()) stream->Draw();
    }
    gl.Disable(GL_CULL_FACE);
    for (const GLenum plane : {GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1}) gl.Disable(plane);
  }

  void UseOnBodies(GLuint program, const Shot& shot) {
    Use(program, shot);
    SetPixelGeometry(gl, program, shot.camera, shot.room);
    SetLights(gl, program, LightsOf(shot.room));
  }

  void DrawTexturedBodies(const Shot& shot) {
    UseOnBodies(programs.textured, shot);
    gl.Uniform1i(gl.GetUniformLocation(programs.textured, "skin"), TextureStore::kUnit);
    for (const TexturedRun& some : triangles.textures) {
      textures.Bind(some.texture);
      textured.DrawSome(some.first, some.count);
    }
  }

  void DrawBodies(GLuint program, const VertexStream& stream, const Shot& shot,
                  const std::vector<SurfacePaint>& paints) {
    UseOnBodies(program, shot);
    SetNumber(program, "pixel_angle", 1.0 / shot.camera.intrinsics.fx);
    SetPaints(gl, program, paints);
    stream.Draw();
  }

  void DrawBodies(const Shot& shot, const std::vector<SurfacePaint>& paints) {
    targets.WriteOnly(true, shot.labels, shot.depth);
    gl.Enable(GL_DEPTH_TEST);
    if (!capsules.IsEmpty()) {
      gl.Enable(GL_CULL_FACE);
      DrawBodies(programs.capsule, capsules, shot, {});
      gl.Disable(GL_CULL_FACE);
    }
    if (!faces.IsEmpty()) {
      gl.Enable(GL_CULL_FACE);
      DrawBodies(programs.face, faces, shot, {});
      gl.Disable(GL_CULL_FACE);
    }
    if (all_closed) gl.Enable(GL_CULL_FACE);
    if (!surfaces.IsEmpty()) DrawBodies(programs.surface, surfaces, shot, {});
    if (!painted.IsEmpty()) DrawBodies(programs.painted, painted, shot, paints);
    if (!textured.IsEmpty()) DrawTexturedBodies(shot);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_DEPTH_TEST);
  }

  void Upload(const std::vector<Figure>& figures, const glm::dvec3& eye) {
    // Collect capsules, with and without a face.
    std::vector<CapsuleInstance> plain = MakeInstances(figures, eye), with_face;
    const auto first_face = std::stable_partition(
        plain.begin(), plain.end(), [](const CapsuleInstance& instance) { return instance.paint.a == 0; });
    with_face.assign(first_face, plain.end());
    plain.erase(first_face, plain.end());
    capsules.Upload(plain);
    faces.Upload(with_face);
    // Collect surfaces.
    all_closed = AllClosed(figures);
    MakeTriangles(figures, eye, triangles);
    surfaces.Upload(triangles.plain.corners, triangles.plain.indices);
    painted.Upload(triangles.painted.corners, triangles.painted.indices);
    textured.Upload(triangles.textured.corners, triangles.textured.indices);
  }

  // Draws bodies, and in the studio the shadows of surfaces, over `view`, in the rectangles `rects` of the picture. The
  // first row of `view` is row `top_row` of the picture.
  void DrawTouched(const KeptRoom& kept, const Room& room, const std::vector<Figure>& figures, const Camera& camera,
                   Targets asked, const std::vector<PixelRect>& rects, int top_row, View& view) {
    if (rects.empty()) return;
    Begin(kept, camera, asked);
    Upload(figures, camera.p_WC);
    const Shot shot{room, camera, rects, asked != Targets::kColour, asked == Targets::kAll};
    targets.WriteOnly(true, shot.labels, shot.depth);
    targets.Clear(rects);
    if (room.casts_shadows && room.interior == nullptr) DrawShadowsOfSurfaces(shot);
    DrawBodies(shot, PaintsOf(figures));
    for (const PixelRect& rect : rects) targets.Read(rect, top_row, asked, view);
  }

  void DrawOver(const KeptRoom& kept, const std::vector<Figure>& figures, const Camera& camera, Overlay& overlay) {
    const Room room;
    const std::vector<PixelRect> rects =
        TouchedPixels(room, figures, camera, {0, camera.intrinsics.height}, /*with_wall=*/false);
    if (rects.empty()) return;
    Begin(kept, camera, Targets::kColour);
    Upload(figures, camera.p_WC);
    targets.WriteOnly(true, false, false);
    targets.Clear(rects);
    MarkShadowsOfSurfaces(room, camera);
    DrawBodies({room, camera, rects, false, false}, PaintsOf(figures));
    for (const PixelRect& rect : rects) {
      targets.Read(rect, overlay);
      overlay.drawn = Union(overlay.drawn, rect);
    }
  }

  std::unique_ptr<GlContext> context;
  const GlFunctions& gl;
  Programs programs;
  GLuint empty_vertices;
  VertexStream capsules, faces, surfaces, painted, textured;
  TextureStore textures;
  bool all_closed = false;     // true if all surfaces are closed, so no back is visible
  SurfaceTriangles triangles;  // memory reused from picture to picture
  FrameTargets targets;
  KeptRooms rooms;
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() { state_->context->MakeCurrent(); }

Result<std::unique_ptr<Renderer>> Renderer::Create() {
  ASSIGN_OR_RETURN(auto context, GlContext::Create());
  ASSIGN_OR_RETURN(const auto programs, LinkAll(*context));
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<State>(std::move(context), programs)));
}

Result<Renderer*> SharedRenderer() {
  // The shared renderer is never destroyed, because Mesa may already be unloaded at exit.
  static const auto* const shared = new Result<std::unique_ptr<Renderer>>(Renderer::Create());
  if (!*shared) return tl::unexpected(shared->error());
  return (*shared)->get();
}

Result<void> CheckRendererChoice() { return CheckGlChoice(); }

Result<void> LoadRenderer() {
  RETURN_IF_ERROR(LoadedGlLibrary());
  return {};
}

std::string RendererVersion() {
  static const std::string version = [] {
    const auto context = GlContext::Create();
    if (!context) return context.error().message;
    const auto* of_gl = (*context)->functions().GetString(GL_VERSION);
    if (of_gl == nullptr) return std::string("unknown version");
    return fmt::format("{}, by {}", reinterpret_cast<const char*>(of_gl), (*context)->library());
  }();
  return version;
}

View Renderer::Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets) {
  return RenderRows(room, figures, camera, targets, {0, camera.intrinsics.height});
}

View Renderer::RenderRows(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets,
                          const RowRange& rows) {
  const int width = camera.intrinsics.width;
  [[maybe_unused]] const int height = camera.intrinsics.height;
  assert(width > 0 && height > 0 && width <= kMaxPictureSide && height <= kMaxPictureSide);
  assert(0 <= rows.first && rows.first < rows.end && rows.end <= height);
  state_->context->MakeCurrent();
  // Draw the empty room with the shadows of capsules.
  const KeptRoom& kept = state_->rooms.FindOrDraw(room, camera);
  View view;
  FillBackdrop(kept, width, room.brightness, targets, rows, view);
  if (room.casts_shadows) CastCapsuleShadows(kept, room, figures, targets, rows, view);
  // Draw the figures.
  state_->DrawTouched(kept, room, figures, camera, targets, TouchedPixels(room, figures, camera, rows), rows.first,
                      view);
  return view;
}

void Renderer::DrawFigures(const std::vector<Figure>& figures, const Camera& camera, Overlay& overlay) {
  const int width = camera.intrinsics.width, height = camera.intrinsics.height;
  state_->context->MakeCurrent();
  // Clear the drawing of the last picture.
  if (overlay.width != width || overlay.height != height) {
    overlay = {width, height, std::vector(4 * static_cast<std::size_t>(width) * height, std::uint8_t{255}), {}};
  }
  const PixelRect& last = overlay.drawn;
  for (int y = last.top; y < last.bottom; ++y) {
    std::memset(&overlay.bytes[4 * (static_cast<std::size_t>(y) * width + last.left)], Overlay::kNothing,
                4 * static_cast<std::size_t>(last.Width()));
  }
  overlay.drawn = {};
  // Draw bodies and mark shadows.
  const KeptRoom& kept = state_->rooms.FindOrDraw({}, camera);
  state_->DrawOver(kept, figures, camera, overlay);
  MarkCapsuleShadows(kept, figures, overlay);
}

}  // namespace etude
