#include "sim/mesh/obj_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/file.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

/// One number means a grey. Nothing for a spectrum or unreadable numbers.
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

ObjMaterials::ObjMaterials(std::string path) : path_(std::move(path)), current_(kDefaultMaterial) {}

void ObjMaterials::read_library(std::istream& file, const std::filesystem::path& library,
                                const std::filesystem::path& folder) {
  std::vector<std::string_view> words;
  std::string material;
  LineReader lines(file);
  for (std::string_view line; lines.next(line);) {
    split(line, words);
    if (words.size() < 2) continue;
    const std::string keyword = in_lower_case(words[0]);  // whatever case an exporter writes
    const Words values = Words(words).subspan(1);
    if (keyword == "newmtl") {
      material = joined(values);
      entries_.try_emplace(material);
    } else if (keyword == "kd" && !material.empty()) {
      if (const auto rgb = colour_in(values)) entries_[material].rgb = rgb;
    } else if (keyword == "map_kd" && !material.empty()) {
      read_map(values, folder, entries_[material]);
      has_pictures_ = true;
    }
  }
  need_whole(file, library);
  has_library_ = true;
  if (!is_named_ && index_of_.empty() && !material.empty()) current_ = material;
}

void ObjMaterials::read_map(Words values, const std::filesystem::path& folder, Entry& to) {
  constexpr std::array<std::string_view, 10> kOfOneWord = {
      "-blendu", "-blendv", "-cc", "-clamp", "-imfchan",
      "-boost",  "-texres", "-bm", "-type",  "-colorspace"};
  while (values.size() > 1 && values[0].starts_with('-')) {
    const std::string_view option = values[0];
    const bool is_placing = option == "-s" || option == "-o" || option == "-t";
    const bool is_one = std::ranges::find(kOfOneWord, option) != kOfOneWord.end();
    if (!is_placing && !is_one && option != "-mm") break;  // a name
    if (option == "-mm" || option == "-t") to.unread_option = option;
    const std::size_t most = is_one ? 1 : option == "-mm" ? 2 : 3;
    values = values.subspan(1);
    if (option == "-clamp") to.is_clamped = values[0] == "on";
    for (std::size_t i = 0; i < most && values.size() > 1; ++i, values = values.subspan(1)) {
      const auto number = read_decimal(values[0]);
      if (!number && !is_one) break;
      if (is_placing && option != "-t" && i < 2) {
        (option == "-s" ? to.scale : to.offset)[static_cast<Eigen::Index>(i)] =
            static_cast<float>(*number);
      }
    }
  }
  std::string name = joined(values);
  if (name.size() > 2 && name.front() == '"' && name.back() == '"') {
    name = name.substr(1, name.size() - 2);
  }
  to.map = folder.empty() ? name : (folder / name).string();
}

void ObjMaterials::use(const std::string& name) {
  if (!is_named_ && current_ == kDefaultMaterial && !index_of_.empty()) index_of_ = {{name, 0}};
  is_named_ = true;
  if (name != current_) index_.reset();
  current_ = name;
}

std::uint16_t ObjMaterials::index_for_face() {
  if (index_) return *index_;
  const std::size_t next = index_of_.size();
  const auto [entry, is_new] = index_of_.try_emplace(current_, static_cast<std::uint16_t>(next));
  if (is_new) as_index<std::uint16_t>(next, path_, "materials");
  index_ = entry->second;
  return *index_;
}

std::vector<Material> ObjMaterials::materials(TextureFiles& textures,
                                              std::vector<std::string>& warnings) {
  std::vector<Material> out(index_of_.size());
  used_.resize(index_of_.size());
  std::size_t unknown = 0;
  std::string first_unknown;
  for (const auto& [name, index] : index_of_) {
    auto found = entries_.find(name);
    if (found == entries_.end()) found = entries_.find(name.substr(0, name.find(" #")));
    if (found != entries_.end()) {
      used_[index] = found->second;
    } else if (has_library_ && name != kDefaultMaterial && unknown++ == 0) {
      first_unknown = name.substr(0, 100);
    }
    const Entry& entry = used_[index];
    Material& material = out[index];
    material = {.name = name, .rgb = entry.rgb.value_or(kDefaultColour)};
    if (entry.map.empty()) continue;
    const Wrap wrap = entry.is_clamped ? Wrap::clamp : Wrap::repeat;
    material.texture = textures.at(entry.map, {wrap, wrap});
    constexpr std::array kWhite = {1.0F, 1.0F, 1.0F};
    const bool is_black = entry.rgb == std::array{0.0F, 0.0F, 0.0F};
    if (material.texture.image && (!entry.rgb || is_black)) material.rgb = kWhite;
    if (!entry.unread_option.empty()) {
      warnings.push_back(fmt::format("{}: material {}: the option {} of its map_Kd is not read",
                                     path_, name, entry.unread_option));
    }
  }
  if (unknown > 0) {
    warnings.push_back(fmt::format("{}: {} materials in none of its libraries, and grey: first {}",
                                   path_, unknown, first_unknown));
  }
  return out;
}

Vec2f ObjMaterials::placed(std::size_t material, const Vec2f& uv) const {
  const Entry& entry = used_[material];
  const Vec2f at = entry.scale.cwiseProduct(uv) + entry.offset;
  return {at.x(), 1.0F - at.y()};
}

}  // namespace gnbv
