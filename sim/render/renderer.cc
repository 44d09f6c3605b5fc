#include "sim/render/renderer.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "sim/render/averaged.h"
#include "sim/render/backdrop.h"
#include "sim/render/capsule_batch.h"
#include "sim/render/frame_targets.h"
#include "sim/render/kept_rooms.h"
#include "sim/render/pixel_geometry.h"
#include "sim/render/shaders.h"
#include "sim/render/surface_batch.h"
#include "sim/render/touched_pixels.h"
#include "sim/render/vertex_stream.h"

namespace etude {
namespace {

// Surfaces beyond this depth are not drawn, metres.
constexpr float kFarthest = 200;

// A box as one triangle strip.
constexpr GLsizei kStripLength = 14;

// What draws one kind of body, and its shadow.
struct BodyPrograms {
  GLuint body = 0;
  GLuint shadow = 0;
};

struct Programs {
  GLuint studio = 0;
  GLuint interior = 0;
  GLuint backdrop = 0;
  GLuint interior_shadow = 0;
  GLuint contact = 0;
  BodyPrograms capsules;
  BodyPrograms surfaces;
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
      {programs.backdrop, FullScreenVertexShader(), BackdropFragmentShader(), {}},
      {programs.interior_shadow, InteriorShadowVertexShader(), InteriorShadowFragmentShader(), capsule},
      {programs.contact, ContactVertexShader(), ContactFragmentShader(), capsule},
      {programs.capsules.body, CapsuleVertexShader(), CapsuleFragmentShader(), capsule},
      {programs.capsules.shadow, CapsuleShadowVertexShader(), CapsuleShadowFragmentShader(), capsule},
      {programs.surfaces.body, SurfaceVertexShader(), SurfaceFragmentShader(), corner},
      {programs.surfaces.shadow, SurfaceShadowVertexShader(), SurfaceShadowFragmentShader(), corner},
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

// The empty room with smooth edges, and the last large picture: only what figures touch of it is current.
struct SmoothRoom {
  std::uint64_t room = 0;  // KeptRoom::serial
  double brightness = 0;
  View large;
  ColourImage small;
};

// From the lamp to the farthest corner of the room.
double ShadowReach(const Interior& interior) {
  const glm::dvec3& lamp = interior.lights.key;
  return glm::length(glm::max(glm::abs(interior.high - lamp), glm::abs(interior.low - lamp)));
}

}  // namespace

struct Renderer::State {
  State(std::unique_ptr<GlContext> made, const Programs& linked)
      : context(std::move(made)),
        gl(context->functions()),
        programs(linked),
        empty_vertices(MakeVertexArray(gl)),
        capsules(CapsuleStream(gl)),
        casters(CapsuleStream(gl)),
        contacts(CapsuleStream(gl)),
        surfaces(CornerStream(gl)),
        targets(gl),
        rooms(gl, linked.studio, linked.interior, empty_vertices) {
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.CullFace(GL_FRONT);  // box faces turned away are in sight even from inside the box
    gl.BlendEquation(GL_MIN);
    for (const GLuint program : {linked.backdrop, linked.interior_shadow, linked.contact}) {
      gl.UseProgram(program);
      gl.Uniform1i(gl.GetUniformLocation(program, "kept_extra"), 1);
    }
  }

  // One picture's wishes.
  struct Shot {
    const Room& room;
    const Camera& camera;
    const std::vector<PixelRect>& rects;
    bool labels, depth;
  };

  void Use(GLuint program, const Shot& shot) {
    gl.UseProgram(program);
    SetNumber(program, "brightness", shot.room.brightness);
    SetNumber(program, "farthest", kFarthest);
  }

  void SetNumber(GLuint program, const char* name, double value) {
    gl.Uniform1f(gl.GetUniformLocation(program, name), static_cast<float>(value));
  }

  void Begin(const KeptRoom& room, const Camera& camera) {
    targets.Begin(camera.intrinsics.width, camera.intrinsics.height);
    gl.ActiveTexture(GL_TEXTURE1);
    gl.BindTexture(GL_TEXTURE_2D, room.extra);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, room.room);
  }

  // The empty room again, with its depths, so that bodies can stand behind what stands there.
  void DrawBackdrop(const Shot& shot) {
    Use(programs.backdrop, shot);
    targets.WriteOnly(true, shot.labels, shot.depth);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_ALWAYS);
    gl.Enable(GL_SCISSOR_TEST);
    gl.BindVertexArray(empty_vertices);
    for (const PixelRect& rect : shot.rects) {
      gl.Scissor(rect.left, rect.top, rect.Width(), rect.Height());
      gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl.DepthFunc(GL_LESS);
    gl.Disable(GL_DEPTH_TEST);
    PixelRect all = shot.rects.front();
    for (const PixelRect& rect : shot.rects) {
      all = {std::min(all.left, rect.left), std::min(all.top, rect.top), std::max(all.right, rect.right),
             std::max(all.bottom, rect.bottom)};
    }
    gl.Scissor(all.left, all.top, all.Width(), all.Height());
  }

  void ThrowShadows(GLuint program, const VertexStream& stream, const Shot& shot) {
    Use(program, shot);
    SetPixelGeometry(gl, program, shot.camera, shot.room);
    for (const int onto_wall : {0, 1}) {
      gl.Uniform1i(gl.GetUniformLocation(program, "onto_wall"), onto_wall);
      stream.Draw();
    }
  }

  void DrawStudioShadows(const Shot& shot) {
    if (!capsules.IsEmpty()) ThrowShadows(programs.capsules.shadow, capsules, shot);
    if (!surfaces.IsEmpty()) {
      for (const GLenum plane : {GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1}) gl.Enable(plane);
      ThrowShadows(programs.surfaces.shadow, surfaces, shot);
      for (const GLenum plane : {GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1}) gl.Disable(plane);
    }
  }

  void DrawInteriorShadows(const Shot& shot) {
    gl.Enable(GL_CULL_FACE);
    if (!casters.IsEmpty()) {
      const GLuint program = programs.interior_shadow;
      Use(program, shot);
      SetPixelGeometry(gl, program, shot.camera, shot.room);
      SetNumber(program, "shadow_reach", ShadowReach(*shot.room.interior));
      casters.Draw();
    }
    if (!contacts.IsEmpty()) {
      targets.WriteOnly(true, false, false);
      Use(programs.contact, shot);
      SetPixelGeometry(gl, programs.contact, shot.camera, shot.room);
      SetNumber(programs.contact, "reach", kContactReach);
      contacts.Draw();
    }
    gl.Disable(GL_CULL_FACE);
  }

  // Each body darkens on its own; where shadows overlap the darkest counts, not their product.
  void DrawShadows(const Shot& shot) {
    targets.WriteOnly(true, shot.labels, false);
    gl.Enablei(GL_BLEND, 0);
    if (shot.room.interior != nullptr) {
      DrawInteriorShadows(shot);
    } else {
      DrawStudioShadows(shot);
    }
    gl.Disablei(GL_BLEND, 0);
  }

  void DrawBodies(GLuint program, const VertexStream& stream, const Shot& shot,
                  const std::vector<SurfacePaint>& paints) {
    Use(program, shot);
    SetPixelGeometry(gl, program, shot.camera, shot.room);
    SetLights(gl, program, LightsOf(shot.room));
    SetNumber(program, "pixel_angle", 1.0 / shot.camera.intrinsics.fx);
    SetPaints(gl, program, paints);
    stream.Draw();
  }

  void DrawBodies(const Shot& shot, const std::vector<SurfacePaint>& paints) {
    targets.WriteOnly(true, shot.labels, shot.depth);
    gl.Enable(GL_DEPTH_TEST);
    if (!capsules.IsEmpty()) {
      gl.Enable(GL_CULL_FACE);
      DrawBodies(programs.capsules.body, capsules, shot, {});
      gl.Disable(GL_CULL_FACE);
    }
    if (!surfaces.IsEmpty()) DrawBodies(programs.surfaces.body, surfaces, shot, paints);
    gl.Disable(GL_DEPTH_TEST);
  }

  void Upload(const Room& room, const std::vector<Figure>& figures, const glm::dvec3& eye) {
    capsules.Upload(MakeInstances(figures, eye));
    MakeCorners(figures, eye, corners);
    surfaces.Upload(corners);
    if (room.interior == nullptr || !room.casts_shadows) return;
    const std::vector<CapsuleInstance> all = MakeCasters(figures, eye);
    casters.Upload(all);
    contacts.Upload(NearFloor(all, eye));
  }

  // `rects` of the picture, into `view`, whose pictures begin with `top_row`.
  void DrawTouched(const KeptRoom& kept, const Room& room, const std::vector<Figure>& figures, const Camera& camera,
                   Targets asked, const std::vector<PixelRect>& rects, int top_row, View& view) {
    if (rects.empty()) return;
    Begin(kept, camera);
    Upload(room, figures, camera.p_WC);
    const Shot shot{room, camera, rects, asked != Targets::kColour, asked == Targets::kAll};
    DrawBackdrop(shot);
    if (room.casts_shadows) DrawShadows(shot);
    DrawBodies(shot, PaintsOf(figures));
    for (const PixelRect& rect : rects) targets.Read(rect, top_row, asked, view);
  }

  std::unique_ptr<GlContext> context;
  const GlFunctions& gl;
  Programs programs;
  GLuint empty_vertices;
  VertexStream capsules, casters, contacts, surfaces;
  std::vector<SurfaceCorner> corners;  // reused
  FrameTargets targets;
  KeptRooms rooms;
  SmoothRoom smooth;
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() { state_->context->MakeCurrent(); }

Result<std::unique_ptr<Renderer>> Renderer::Create() {
  ASSIGN_OR_RETURN(auto context, GlContext::Create());
  ASSIGN_OR_RETURN(const auto programs, LinkAll(*context));
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<State>(std::move(context), programs)));
}

Result<Renderer*> SharedRenderer() {
  // Never destroyed: Mesa may be gone by then.
  static const auto* const shared = new Result<std::unique_ptr<Renderer>>(Renderer::Create());
  if (!*shared) return tl::unexpected(shared->error());
  return (*shared)->get();
}

std::string RendererVersion() {
  const auto context = GlContext::Create();
  if (!context) return context.error().message;
  const auto* version = (*context)->functions().GetString(GL_VERSION);
  return version == nullptr ? "unknown version" : reinterpret_cast<const char*>(version);
}

View Renderer::Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets) {
  return RenderRows(room, figures, camera, targets, {0, camera.intrinsics.height});
}

View Renderer::RenderRows(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets,
                          const RowRange& rows) {
  const int width = camera.intrinsics.width, height = camera.intrinsics.height;
  assert(width > 0 && height > 0 && width <= kLargestPicture && height <= kLargestPicture);
  assert(0 <= rows.first && rows.first < rows.end && rows.end <= height);
  state_->context->MakeCurrent();
  const KeptRoom& kept = state_->rooms.FindOrDraw(room, camera);
  View view;
  FillBackdrop(kept, width, room.brightness, targets, rows, view);
  state_->DrawTouched(kept, room, figures, camera, targets, TouchedPixels(room, figures, camera, rows), rows.first,
                      view);
  return view;
}

ColourImage Renderer::RenderSmooth(const Room& room, const std::vector<Figure>& figures, const Camera& camera) {
  const Camera large = Doubled(camera);
  const int width = large.intrinsics.width, height = large.intrinsics.height;
  assert(width <= kLargestPicture && height <= kLargestPicture);
  State& state = *state_;
  state.context->MakeCurrent();
  const KeptRoom& kept = state.rooms.FindOrDraw(room, large);
  const RowRange rows{0, height};
  // Most films stay in one light: the empty room then is averaged once.
  SmoothRoom& smooth = state.smooth;
  if (smooth.room != kept.serial || smooth.brightness != room.brightness) {
    FillBackdrop(kept, width, room.brightness, Targets::kColour, rows, smooth.large);
    smooth.small = ColourImage(camera.intrinsics.width, camera.intrinsics.height);
    AverageFours(smooth.large.colour, {0, 0, width, height}, smooth.small);
    smooth.room = kept.serial;
    smooth.brightness = room.brightness;
  }
  ColourImage picture = smooth.small;
  std::vector<PixelRect> rects = TouchedPixels(room, figures, large, rows);
  for (PixelRect& rect : rects) {
    rect = {rect.left & ~1, rect.top & ~1, (rect.right + 1) & ~1, (rect.bottom + 1) & ~1};
  }
  state.DrawTouched(kept, room, figures, large, Targets::kColour, rects, 0, smooth.large);
  for (const PixelRect& rect : rects) AverageFours(smooth.large.colour, rect, picture);
  return picture;
}

}  // namespace etude
