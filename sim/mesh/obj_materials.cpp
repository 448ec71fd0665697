#include "sim/mesh/obj_materials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"
#include "sim/mesh/chunked_file.hpp"
#include "sim/mesh/plain_text.hpp"

namespace gnbv {
namespace {

/// A grey where there is one number; nothing where it is a spectrum or unreadable.
std::optional<std::array<float, 3>> colour_in(Words words) {
  std::array<float, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = read_decimal(words[std::min(i, words.size() - 1)]);
    if (!value || std::isnan(*value)) return std::nullopt;
    rgb[i] = static_cast<float>(std::clamp(*value, 0.0, 1.0));
  }
  return rgb;
}

}  // namespace

void ObjMaterials::read_library(const std::filesystem::path& library) {
  ChunkedFile file(library);
  std::vector<std::string_view> words;
  std::string material;
  while (const auto line = file.line()) {
    split(*line, words);
    if (words.size() < 2) continue;
    const Words values = Words(words).subspan(1);
    if (words[0] == "newmtl") {
      material = joined(values);
      rgb_of_.try_emplace(material, kUntoldColour);
    } else if (words[0] == "Kd" && !material.empty()) {
      if (const auto rgb = colour_in(values)) rgb_of_[material] = *rgb;
    }
  }
  if (!is_named_ && used_.empty() && !material.empty()) current_ = material;
}

void ObjMaterials::use(const std::string& name) {
  if (!is_named_ && current_ == kUntoldMaterial && !used_.empty()) {
    used_ = {name};
    index_of_ = {{name, std::uint16_t{0}}};
  }
  is_named_ = true;
  if (name != current_) index_.reset();
  current_ = name;
}

std::uint16_t ObjMaterials::index_for_face() {
  if (index_) return *index_;
  const auto [entry, is_new] =
      index_of_.try_emplace(current_, static_cast<std::uint16_t>(used_.size()));
  if (is_new) {
    if (used_.size() > std::numeric_limits<std::uint16_t>::max()) {
      throw BadInput(fmt::format("{}: more than 65536 materials", path_));
    }
    used_.push_back(current_);
  }
  index_ = entry->second;
  return *index_;
}

std::vector<Material> ObjMaterials::materials() const {
  std::vector<Material> out;
  for (const std::string& name : used_) {
    const auto found = rgb_of_.find(name);
    out.push_back({.name = name, .rgb = found != rgb_of_.end() ? found->second : kUntoldColour});
  }
  return out;
}

std::string obj_name_of_material(const TriangleMesh& mesh, std::size_t index) {
  const std::string& name = mesh.materials[index].name;
  return name.empty() ? fmt::format("material_{}", index) : name;
}

std::string mtl_text_of(const TriangleMesh& mesh) {
  std::string out;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const auto& [r, g, b] = mesh.materials[i].rgb;
    fmt::format_to(std::back_inserter(out), "newmtl {}\nKd {} {} {}\n",
                   obj_name_of_material(mesh, i), r, g, b);
  }
  return out;
}

}  // namespace gnbv
