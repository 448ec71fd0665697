// take_colours() of sim/mesh/polygon_mesh.hpp.
#include <fmt/format.h>

#include <set>
#include <unordered_map>

#include "sim/core/srgb.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kExactColours = 256;

std::uint32_t channel_of(std::uint32_t rgb, unsigned shift) { return (rgb >> shift) & 0xffU; }

std::uint32_t in_steps(std::uint32_t rgb) {
  std::uint32_t out = 0;
  for (const unsigned shift : {16U, 8U, 0U}) out |= (channel_of(rgb, shift) + 8) / 17 * 17 << shift;
  return out;
}

bool are_few(std::span<const std::uint32_t> colours) {
  std::set<std::uint32_t> found;
  for (const std::uint32_t rgb : colours) {
    found.insert(rgb);
    if (found.size() > kExactColours) return false;
  }
  return true;
}

Material material_of(std::uint32_t rgb) {
  const auto linear = [&](unsigned shift) {
    return srgb_to_linear(static_cast<float>(channel_of(rgb, shift)) / 255.0F);
  };
  return {.name = fmt::format("colour_{:06x}", rgb), .rgb = {linear(16), linear(8), linear(0)}};
}

}  // namespace

void take_colours(std::span<const std::uint32_t> face_rgb, std::vector<Material>& materials,
                  std::vector<std::uint16_t>& face_material) {
  const bool are_exact = are_few(face_rgb);
  std::unordered_map<std::uint32_t, std::uint16_t> index_of;
  materials.clear();
  face_material.clear();
  face_material.reserve(face_rgb.size());
  for (const std::uint32_t file_rgb : face_rgb) {
    const std::uint32_t rgb = are_exact ? file_rgb : in_steps(file_rgb);
    const auto next = static_cast<std::uint16_t>(materials.size());
    const auto [entry, is_new] = index_of.try_emplace(rgb, next);
    if (is_new) materials.push_back(material_of(rgb));
    face_material.push_back(entry->second);
  }
}

}  // namespace gnbv
