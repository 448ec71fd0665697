#include <algorithm>
#include <cstring>
#include <span>

#include "sim/core/error.hpp"
#include "tools/render/renderer_impl.hpp"

namespace gnbv {
namespace {

PixelBox whole(int width, int height) {
  return {Eigen::Vector2i(0, 0), Eigen::Vector2i(width - 1, height - 1)};
}

// kHollowFragment looks no farther than this share of the height, kResolveFragment two pixels.
int hollow_reach_px(int height) { return height * 12 / 100 + 2; }

// Rows from the bottom as rows from the top.
PixelBox upside_down(PixelBox box, int height) {
  if (box.isEmpty()) return box;
  const int low = box.min().y();
  box.min().y() = height - 1 - box.max().y();
  box.max().y() = height - 1 - low;
  return box;
}

// Adds their triangles to the indices.
ThingsToDraw things_to_draw(const DrawLists& lists, const FrameBlock& frame, const PixelBox& box,
                            int width, int height, Indices& indices) {
  ThingsToDraw seen{.first = indices.size(),
                    .dots = dots_in_picture(lists.dots, frame, box, width, height)};
  const auto places = places_px(lists.vertices, frame, width, height);
  const auto add = [&](const Indices& list) {
    const Indices near = triangles_in_picture(places, list, box);
    indices.insert(indices.end(), near.begin(), near.end());
    return near.size();
  };
  seen.opaque = add(lists.casting);
  seen.opaque += add(lists.plain);
  seen.ghost = add(lists.ghost);
  seen.translucent = add(lists.translucent);
  return seen;
}

}  // namespace

// `first` and `count` are in indices.
void Renderer::Impl::draw_solids(GLuint program, std::size_t first, std::size_t count) {
  gl.UseProgram(program);
  gl.BindVertexArray(solids);
  gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                  reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

void Renderer::Impl::draw_points(GLuint program, GLuint array, std::size_t count) {
  gl.UseProgram(program);
  gl.BindVertexArray(array);
  gl.DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count));
}

void Renderer::Impl::draw_screen(GLuint program) {
  gl.UseProgram(program);
  gl.BindVertexArray(nothing);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

// What the key light sees.
void Renderer::Impl::draw_shadows(const DrawLists& lists, const FrameBlock& frame,
                                  const PixelBox& box) {
  const std::vector<DrawDot> casting =
      dots_in_shadow_map(std::span(lists.dots).first(lists.casting_dots), frame, box);
  upload_dots(casting);
  gl.BindFramebuffer(GL_FRAMEBUFFER, targets[kShadow]);
  gl.Viewport(0, 0, kShadowSide_px, kShadowSide_px);
  draw_only_in(box);
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_PROGRAM_POINT_SIZE);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  draw_solids(solid_shadow, 0, lists.casting.size());
  draw_points(ball_shadow, balls, lists.casting_balls);
  draw_points(ball_shadow, dots, casting.size());
}

// The picture: solids and clouds, then ground, ghosts and translucent faces over them.
void Renderer::Impl::draw_things(const RenderScene& scene, const RenderView& view,
                                 const DrawLists& lists, const ThingsToDraw& seen) {
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  gl.DepthMask(GL_FALSE);
  gl.Disable(GL_DEPTH_TEST);
  draw_screen(background);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  draw_solids(solid, seen.first, seen.opaque);
  draw_points(ball, balls, lists.balls.size());
  draw_points(dot, dots, seen.dots.size());
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl.DepthMask(GL_FALSE);
  if (scene.ground && view.T_world_camera.translation().z() > scene.ground->z_m) {
    gl.UseProgram(ground);
    gl.BindVertexArray(nothing);
    gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  const std::size_t ghosts = seen.first + seen.opaque;
  // the nearest layer of the ghosts: first where it is, then how it looks
  // ghosts lie a little farther away, so that dots on them show whole
  gl.Enable(GL_POLYGON_OFFSET_FILL);
  gl.PolygonOffset(4.0F, 4.0F);
  gl.DepthMask(GL_TRUE);
  gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_solids(solid, ghosts, seen.ghost);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.DepthFunc(GL_LEQUAL);
  draw_solids(solid, ghosts, seen.ghost);
  gl.Disable(GL_POLYGON_OFFSET_FILL);
  gl.DepthMask(GL_FALSE);
  draw_solids(solid, ghosts + seen.ghost, seen.translucent);
  gl.Disable(GL_BLEND);
  gl.Disable(GL_FRAMEBUFFER_SRGB);
  gl.Disable(GL_DEPTH_TEST);
}

// All of it, or of a series what differs from the picture before; remembers this one.
ChangedArea Renderer::Impl::area_to_draw(const RenderScene& scene, const RenderView& view,
                                         const DrawLists& lists, const FrameBlock& frame) {
  const ChangedArea all{whole(view.width_px, view.height_px),
                        whole(kShadowSide_px, kShadowSide_px)};
  if (!scene.series_box_m) {
    last.reset();
    return all;
  }
  std::optional<RememberedPicture> before{{frame, lists}};
  std::swap(before, last);
  const bool is_same_view = before && std::memcmp(&before->frame, &frame, sizeof(frame)) == 0 &&
                            sizes_px[kFinal] == std::array{view.width_px, view.height_px};
  if (!is_same_view) return all;
  const auto lowest_m = static_cast<float>(scene.series_box_m->min().z());
  return changed_area(changed_things(before->lists, lists), frame,
                      std::min(lowest_m, frame.ground.z()), view.width_px, view.height_px)
      .value_or(all);
}

Image Renderer::Impl::read_picture(int width, int height) {
  Image image{width, height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  const GLenum error = gl.GetError();
  if (error == GL_OUT_OF_MEMORY) {
    throw BadInput(
        fmt::format("picture size {} x {} px: too little memory; ask for less with --width and "
                    "--height",
                    width, height));
  }
  GNBV_CHECK(error == GL_NO_ERROR, "OpenGL error {:#x} at {} x {} px", error, width, height);
  return image;
}

Image Renderer::Impl::render(const RenderScene& scene, const RenderView& view) {
  const int width = view.width_px;
  const int height = view.height_px;
  if (std::min(width, height) < 1 || std::max(width, height) > kMaxSide_px) {
    throw BadInput(fmt::format("picture size {} x {} px: both must be from 1 to {}", width, height,
                               kMaxSide_px));
  }
  if (std::int64_t{width} * height > kMaxArea_px) {
    throw BadInput(
        fmt::format("picture size {} x {} px: more than {} pixels; ask for less with "
                    "--width and --height",
                    width, height, kMaxArea_px));
  }
  context.make_current();
  const DrawLists lists = make_draw_lists(scene);
  const FrameBlock frame = make_frame_block(scene, view, lists);
  const auto [box, shadow_box] = area_to_draw(scene, view, lists, frame);
  const PixelBox hollow_box = widened(box, hollow_reach_px(height), width, height);
  const PixelBox end_box = widened(hollow_box, 2, width, height);
  Indices indices_to_draw = lists.casting;  // all of them may throw shadows
  const ThingsToDraw seen = things_to_draw(lists, frame, box, width, height, indices_to_draw);
  upload(lists, indices_to_draw, frame);
  if (scene.paint) upload_paint(*scene.paint, view);
  draw_shadows(lists, frame, shadow_box);
  begin_target(kPicture, kSrgb, 2 * width, 2 * height);
  draw_only_in(box.isEmpty() ? box : PixelBox(2 * box.min(), (2 * box.max()).array() + 1));
  upload_dots(seen.dots);
  draw_things(scene, view, lists, seen);
  begin_target(kDistances, kFloat, width, height);
  draw_only_in(box);
  draw_screen(distance);
  begin_target(kShade, kByte, width, height);
  draw_only_in(hollow_box);
  draw_screen(hollow);
  begin_target(kFinal, kRgb, width, height);
  draw_only_in(upside_down(end_box, height));
  draw_screen(resolve);
  return read_picture(width, height);
}

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;
Image Renderer::render(const RenderScene& scene, const RenderView& view) {
  return impl_->render(scene, view);
}

Image render(const RenderScene& scene, const RenderView& view) {
  Renderer renderer;
  return renderer.render(scene, view);
}

}  // namespace gnbv
