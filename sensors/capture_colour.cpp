// The camera in colour. Its rays are those of capture_depth, so that the two agree pixel by pixel.
#include <limits>
#include <vector>

#include "sensors/capture.hpp"
#include "sensors/light.hpp"
#include "sensors/pixel_tiles.hpp"
#include "sim/core/error.hpp"
#include "sim/texture.hpp"

namespace gnbv {
namespace {

/// Shadow rays begin this far off the surface, towards who looks: more than a float's rounding
/// within a kilometre, less than anything worth a shadow.
constexpr float kOffSurface_m = 1e-3F;

struct ColourCapture {
  const RayScene& scene;
  Vec3f origin_world_m;
  Material ground;
  PixelTiles tiles;
  SrgbTable srgb;
  ColourFrame& frame;

  void row(int tile_row) const {
    const std::vector<Vec3f> directions_world = tiles.directions_world(tile_row);
    std::vector<RayHit> hits(directions_world.size());
    scene.first_hits(origin_world_m, directions_world, 0.0F, std::numeric_limits<float>::infinity(),
                     hits);
    std::vector<Vec3f> normals_world(hits.size(), Vec3f::Zero());
    std::vector<Vec3f> surface_world_m(hits.size(), origin_world_m);
    for (std::size_t ray = 0; ray < hits.size(); ++ray) {
      if (hits[ray].face == kNoFace) continue;
      surface_world_m[ray] = origin_world_m + hits[ray].distance_m * directions_world[ray];
      normals_world[ray] = scene.normal_world(hits[ray]);
      // faces have two sides: the one that is seen is lit
      if (normals_world[ray].dot(directions_world[ray]) > 0.0F) normals_world[ray] *= -1.0F;
    }
    const std::vector<std::uint8_t> is_dark = in_shadow(surface_world_m, normals_world);
    tiles.for_each_pixel(tile_row, [&](std::size_t ray, std::size_t pixel) {
      const std::int32_t face = hits[ray].face;
      if (face == kNoFace) {
        frame.rgb[pixel] = srgb(sky_colour(directions_world[ray]));
        return;
      }
      const Material& material = face == kGroundFace ? ground : scene.material(face);
      const auto [r, g, b] = albedo(material, surface_world_m[ray], normals_world[ray]);
      frame.rgb[pixel] = srgb(lit_colour({r, g, b}, normals_world[ray], is_dark[ray] == 0));
    });
  }

  std::vector<std::uint8_t> in_shadow(std::span<const Vec3f> surface_world_m,
                                      std::span<const Vec3f> normals_world) const {
    std::vector<Vec3f> origins_world_m(surface_world_m.size());
    for (std::size_t i = 0; i < origins_world_m.size(); ++i) {
      origins_world_m[i] = surface_world_m[i] + kOffSurface_m * normals_world[i];
    }
    const std::vector<Vec3f> sunwards(origins_world_m.size(), towards_sun_world());
    std::vector<std::uint8_t> blocked(origins_world_m.size());
    scene.structure_blocks(origins_world_m, sunwards, 0.0F, blocked);
    return blocked;
  }
};

}  // namespace

ColourFrame capture_colour(const RayScene& scene, const CameraModel& camera, int camera_index,
                           const Isometry& T_world_body, int threads) {
  const CameraConfig& config = camera.config;
  GNBV_CHECK(config.width_px > 0 && config.height_px > 0, "camera {} has {} x {} pixels",
             config.name, config.width_px, config.height_px);
  ColourFrame frame;
  frame.camera = camera_index;
  frame.T_world_camera = T_world_body * camera.T_body_camera;
  frame.rgb.resize(static_cast<std::size_t>(config.width_px) *
                   static_cast<std::size_t>(config.height_px));
  const ColourCapture capture = {scene,
                                 frame.T_world_camera.translation().cast<float>(),
                                 ground_material(),
                                 PixelTiles(camera, frame.T_world_camera),
                                 SrgbTable(),
                                 frame};
  for_each_tile_row(capture.tiles, threads, [&](int tile_row) { capture.row(tile_row); });
  return frame;
}

}  // namespace gnbv
