// Pictures on surfaces, of sim/mesh/triangle_mesh.hpp.
#include <algorithm>
#include <cmath>
#include <set>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {
namespace {

using Colour = std::array<float, 3>;

/// srgb_to_linear() of every byte.
const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> kLinear = [] {
    std::array<float, 256> out{};
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = srgb_to_linear(static_cast<float>(i) / 255.0F);
    }
    return out;
  }();
  return kLinear;
}

Colour linear(const Rgb8& rgb) {
  const auto& of = linear_of_byte();
  return {of[rgb[0]], of[rgb[1]], of[rgb[2]]};
}

Colour times(const Colour& a, const Colour& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }

/// The two pixels between whose centres a coordinate lies, and the share of the second.
struct Between {
  std::array<int, 2> pixel{};
  float share = 0.0F;
};

Between between(float u, Wrap wrap, int size) {
  double at = static_cast<double>(u);
  if (wrap == Wrap::repeat) at -= std::floor(at);
  if (wrap == Wrap::mirror) {
    at -= 2.0 * std::floor(at / 2.0);
    at = std::min(at, 2.0 - at);
  }
  at = std::clamp(at, 0.0, 1.0) * size - 0.5;
  const double low = std::floor(at);
  const int first = static_cast<int>(low);
  const auto inside = [&](int i) {
    if (wrap == Wrap::repeat) return (i + size) % size;
    return std::clamp(i, 0, size - 1);  // a mirrored picture meets itself at its border
  };
  return {{inside(first), inside(first + 1)}, static_cast<float>(at - low)};
}

/// Shares of a face's corners at a place in its plane.
std::array<float, 3> barycentric(const TriangleMesh& mesh, std::size_t face, const Vec3& p_m) {
  const auto [a, b, c] = face_corners_m(mesh, face);
  const Vec3 n = (b - a).cross(c - a);
  const double n2 = std::max(n.squaredNorm(), 1e-300);
  const double of_b = std::clamp((p_m - a).cross(c - a).dot(n) / n2, 0.0, 1.0);
  const double of_c = std::clamp((b - a).cross(p_m - a).dot(n) / n2, 0.0, 1.0 - of_b);
  return {static_cast<float>(1.0 - of_b - of_c), static_cast<float>(of_b),
          static_cast<float>(of_c)};
}

/// Of the picture and the corners, where these have such shares.
Colour look_at(const Texture& texture, const std::array<CornerLook, 3>& corners,
               const std::array<float, 3>& shares) {
  Colour tint{};
  Vec2f uv = Vec2f::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Colour of_corner = linear(corners[k].tint);
    for (std::size_t i = 0; i < 3; ++i) tint[i] += shares[k] * of_corner[i];
    uv += shares[k] * corners[k].uv;
  }
  return texture.image && uv.allFinite() ? times(tint, colour_at(texture, uv)) : tint;
}

}  // namespace

Colour colour_at(const Texture& texture, const Vec2f& uv) {
  const Image& image = *texture.image;
  const Between x = between(uv.x(), texture.wrap[0], image.width_px);
  const Between y = between(uv.y(), texture.wrap[1], image.height_px);
  Colour out{};
  for (std::size_t j = 0; j < 2; ++j) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Colour pixel = linear(image.at(x.pixel[i], y.pixel[j]));
      const float weight =
          (i == 0 ? 1.0F - x.share : x.share) * (j == 0 ? 1.0F - y.share : y.share);
      for (std::size_t k = 0; k < 3; ++k) out[k] += weight * pixel[k];
    }
  }
  return out;
}

Colour albedo(const TriangleMesh& mesh, std::size_t face, const Vec3f& p_world_m,
              const Vec3f& normal_world) {
  const Material& material = mesh.materials[material_of(mesh, face)];
  const Colour plain = albedo(material, p_world_m, normal_world);
  if (mesh.face_looks.empty()) return plain;
  return times(plain, look_at(material.texture, mesh.face_looks[face],
                              barycentric(mesh, face, p_world_m.cast<double>())));
}

Colour mean_colour(const TriangleMesh& mesh, std::size_t face) {
  const Material& material = mesh.materials[material_of(mesh, face)];
  if (mesh.face_looks.empty()) return material.rgb;
  constexpr int kSide = 4;  // the face cut into kSide * kSide equal ones, at the centre of each
  Colour sum{};
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < 2 * (kSide - i) - 1; ++j) {
      const float b = (static_cast<float>(i) + (j % 2 == 0 ? 1.0F : 2.0F) / 3.0F) / kSide;
      const float c = (static_cast<float>(j / 2) + (j % 2 == 0 ? 1.0F : 2.0F) / 3.0F) / kSide;
      const Colour at = look_at(material.texture, mesh.face_looks[face], {1.0F - b - c, b, c});
      for (std::size_t k = 0; k < 3; ++k) sum[k] += at[k] / (kSide * kSide);
    }
  }
  return times(material.rgb, sum);
}

std::vector<const Texture*> textures_of(const TriangleMesh& mesh) {
  std::vector<const Texture*> out;
  std::set<const Image*> seen;
  for (const Material& material : mesh.materials) {
    const Image* const image = material.texture.image.get();
    if (image != nullptr && seen.insert(image).second) out.push_back(&material.texture);
  }
  return out;
}

std::size_t bytes_of(const std::vector<const Texture*>& textures) {
  std::size_t bytes = 0;
  for (const Texture* texture : textures) bytes += texture->image->rgb.size();
  return bytes;
}

}  // namespace gnbv
