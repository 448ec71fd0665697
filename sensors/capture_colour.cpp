// The camera in colour, by the same rays as capture_depth.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sensors/capture.hpp"
#include "sensors/pixel_tiles.hpp"
#include "sim/core/image.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {
namespace {

// Linear colours: a sun, a blue sky, and what the ground reflects of both. A white sheet that faces
// the sun comes out just below 1.
const Vec3f kSun(0.70F, 0.66F, 0.58F);         // irradiance over pi, facing the sun
const Vec3f kSkyAmbient(0.22F, 0.25F, 0.30F);  // facing up
const Vec3f kGroundAmbient(0.10F, 0.09F, 0.08F);
const Vec3f kZenith(0.14F, 0.30F, 0.68F);
const Vec3f kHorizon(0.62F, 0.72F, 0.82F);
const Vec3f kHaze(0.30F, 0.29F, 0.27F);

/// Pale at the horizon, blue overhead; haze below the horizon, where a world has no ground.
Vec3f sky_colour(const Vec3f& direction_world) {
  const float height = direction_world.normalized().z();
  if (height < 0.0F) return kHaze;
  return kHorizon + std::sqrt(height) * (kZenith - kHorizon);
}

/// Light that a surface sends back: of the sun by Lambert's law, where it is not in shadow, and of
/// sky and ground by how much of them the surface faces.
Vec3f lit_colour(const Vec3f& albedo, const Vec3f& normal_world, bool is_sunlit) {
  const float upwards = 0.5F + 0.5F * normal_world.z();
  Vec3f light = kGroundAmbient + upwards * (kSkyAmbient - kGroundAmbient);
  if (is_sunlit) light += std::max(0.0F, normal_world.dot(towards_sun_world())) * kSun;
  return albedo.cwiseProduct(light);
}

Material ground_material() {
  Material ground;
  ground.name = "ground";
  ground.pattern = Pattern::noise;
  ground.rgb = {0.34F, 0.32F, 0.29F};
  ground.rgb_2 = {0.17F, 0.17F, 0.14F};
  ground.pattern_size_m = 0.8F;
  return ground;
}

/// Shadow rays begin this far off the surface, on the camera's side: more than the rounding of a
/// float within a kilometre, less than anything whose shadow matters.
constexpr float kOffSurface_m = 1e-3F;

/// What the rays of one packet meet, where it is, and how it is lit.
struct Surface {
  std::array<Vec3f, RayPacket::kRays> p_world_m;
  std::array<Vec3f, RayPacket::kRays> normal_world;  // on the camera's side
  std::array<std::uint8_t, RayPacket::kRays> is_dark{};
};

struct ColourCapture {
  const RayScene& scene;
  Vec3f origin_world_m;
  Material ground;
  PixelTiles tiles;
  SrgbTable srgb;
  ColourFrame& frame;

  void capture(TileRun& run) const {
    scene.first_hits(origin_world_m, run.directions_world, 0.0F, kEndless, run.hits);
    std::vector<Surface> surfaces;
    for (std::size_t tile = 0; tile < run.hits.size(); ++tile) {
      surfaces.push_back(surface_of(run.directions_world[tile], run.hits[tile]));
    }
    tiles.for_each_pixel(run, [&](std::size_t tile, std::size_t ray, std::size_t pixel) {
      if (!tiles.is_seen(pixel)) return;  // black
      const std::int32_t face = run.hits[tile].face[ray];
      const Vec3f linear = face == kNoFace ? sky_colour(run.directions_world[tile].direction(ray))
                                           : colour_of(face, surfaces[tile], ray);
      frame.rgb[pixel] = {srgb(linear.x()), srgb(linear.y()), srgb(linear.z())};
    });
  }

  Surface surface_of(const RayPacket& directions_world, const HitPacket& hits) const {
    Surface surface;
    std::array<Vec3f, RayPacket::kRays> off_surface_m;
    for (std::size_t ray = 0; ray < RayPacket::kRays; ++ray) {
      const bool is_hit = hits.face[ray] != kNoFace;  // else it lies at the camera
      const Vec3f direction = directions_world.direction(ray);
      Vec3f normal = is_hit ? scene.normal_world(hits.face[ray]) : Vec3f::Zero();
      if (normal.dot(direction) > 0.0F) normal = -normal;  // faces have two sides
      surface.normal_world[ray] = normal;
      surface.p_world_m[ray] = origin_world_m;
      if (is_hit) surface.p_world_m[ray] += hits.distance_m[ray] * direction;
      off_surface_m[ray] = surface.p_world_m[ray] + kOffSurface_m * normal;
    }
    std::array<Vec3f, RayPacket::kRays> sunwards;
    sunwards.fill(towards_sun_world());
    scene.find_blocked(kMeshParts, off_surface_m, sunwards, 0.0F, kEndless, surface.is_dark);
    return surface;
  }

  Vec3f colour_of(std::int32_t face, const Surface& surface, std::size_t ray) const {
    const Vec3f& p_world_m = surface.p_world_m[ray];
    const Vec3f& normal_world = surface.normal_world[ray];
    const auto [r, g, b] = face == kGroundFace ? albedo(ground, p_world_m, normal_world)
                                               : scene.albedo(face, p_world_m, normal_world);
    return lit_colour({r, g, b}, normal_world, surface.is_dark[ray] == 0);
  }
};

}  // namespace

Vec3f towards_sun_world() {
  const auto elevation_rad = static_cast<float>(deg_to_rad(50.0));
  const auto azimuth_rad = static_cast<float>(deg_to_rad(-125.0));
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

ColourFrame capture_colour(const RayScene& scene, const CameraModel& camera, int camera_index,
                           const Isometry& T_world_body, int threads) {
  ColourFrame frame;
  frame.camera = camera_index;
  frame.T_world_camera = T_world_body * camera.T_body_camera;
  const ColourCapture capture = {scene,
                                 frame.T_world_camera.translation().cast<float>(),
                                 ground_material(),
                                 PixelTiles(camera, frame.T_world_camera),
                                 SrgbTable(),
                                 frame};
  frame.rgb.resize(capture.tiles.pixel_count());
  capture.tiles.for_each_run(threads, [&](TileRun& run) { capture.capture(run); });
  return frame;
}

}  // namespace gnbv
