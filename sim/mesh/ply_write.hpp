// PLY as this program writes it: clouds and meshes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "sim/core/image.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Besides their places a value a vertex, or none at all.
struct PlyVertices {
  std::span<const Vec3f> places_world_m;
  std::span<const Vec3f> normals = {};
  std::span<const Rgb8> colours = {};
  std::span<const std::int32_t> views = {};
};

struct PlyFaces {
  std::span<const std::array<std::uint32_t, 3>> corners;
  std::span<const Rgb8> colours = {};  // a colour a face, or none at all
};

/// Binary little-endian: float x y z in metres, then, where there are such, float nx ny nz, uchar
/// red green blue, int view; of a mesh the faces, with uchar red green blue where there are such.
std::string ply_bytes(const PlyVertices& vertices, const std::optional<PlyFaces>& faces = {});

}  // namespace gnbv
