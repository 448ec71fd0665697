#include "sim/mesh/gltf_looks.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/error.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

using Json = GltfFile::Json;

constexpr std::array kWhite = {1.0F, 1.0F, 1.0F};

/// Of baseColorFactor or, in files of the years before, of diffuseFactor.
std::array<float, 3> factor_of(const Json& metal, const Json& gloss) {
  std::array<float, 3> rgb = kWhite;
  for (const Json& rgba :
       {metal.value("baseColorFactor", Json()), gloss.value("diffuseFactor", Json())}) {
    if (!rgba.is_array() || rgba.size() < 3) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      if (rgba[k].is_number()) rgb[k] = std::clamp(rgba[k].get<float>(), 0.0F, 1.0F);
    }
    break;
  }
  return rgb;
}

Wrap wrap_of(std::size_t code) {
  constexpr std::size_t kClamp = 33071, kMirror = 33648;
  return code == kClamp ? Wrap::clamp : code == kMirror ? Wrap::mirror : Wrap::repeat;
}

}  // namespace

template <typename Do>
void GltfLooks::attempt(const Do& step) {
  try {
    step();
  } catch (const BadInput& error) {
    faults_.insert(error.what());
  }
}

std::vector<Material> GltfLooks::materials() {
  const Material unnamed = {.name = std::string(kDefaultMaterial), .rgb = kWhite};
  std::size_t count = 0;
  attempt([&] { count = file_.count("materials"); });
  std::vector<Material> out(count + 1, unnamed);
  placings_.resize(count + 1);
  for (std::size_t i = 0; i < count; ++i) {
    attempt([&] {
      const Json& from = file_.item("materials", i);
      const Json& metal = object_in(from, "pbrMetallicRoughness");
      const Json& gloss =
          object_in(object_in(from, "extensions"), "KHR_materials_pbrSpecularGlossiness");
      out[i].name = text_in(from, "name");
      out[i].rgb = factor_of(metal, gloss);
      const bool is_metal = metal.contains("baseColorTexture");
      read_texture(
          is_metal ? object_in(metal, "baseColorTexture") : object_in(gloss, "diffuseTexture"),
          out[i], placings_[i]);
    });
  }
  return out;
}

std::size_t GltfLooks::material_of(const Json& primitive) {
  std::size_t found = placings_.size() - 1;
  attempt([&] { found = file_.index(primitive, "material", "materials").value_or(found); });
  return found;
}

void GltfLooks::read_texture(const Json& info, Material& to, Placing& placing) {
  const auto texture = file_.index(info, "index", "textures");
  if (!texture) return;
  placing.set = file_.size(info, "texCoord", 0);
  const Json& transform = object_in(object_in(info, "extensions"), "KHR_texture_transform");
  if (!transform.empty()) {
    const auto offset = file_.list(transform, "offset", {0, 0});
    const auto scale = file_.list(transform, "scale", {1, 1});
    const auto turned = transform.find("rotation");
    const double angle_rad =
        turned != transform.end() && turned->is_number() ? turned->get<double>() : 0.0;
    // counter-clockwise as one sees it, and v goes down: the matrix of the specification is
    // transposed against its own example
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    placing.T << c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1];
    placing.set = file_.size(transform, "texCoord", placing.set);
  }
  const Json& from = file_.item("textures", *texture);
  std::array<Wrap, 2> wrap = {};
  if (const auto i = file_.index(from, "sampler", "samplers")) {
    const Json& sampler = file_.item("samplers", *i);
    wrap = {wrap_of(file_.size(sampler, "wrapS", 0)), wrap_of(file_.size(sampler, "wrapT", 0))};
  }
  const auto image = file_.index(from, "source", "images");
  if (image) to.texture = picture(*image, wrap);
  placing.is_used = to.texture.image != nullptr;
  if (!image) textures_.miss(fmt::format("textures[{}]", *texture), "neither PNG nor JPEG");
}

Texture GltfLooks::picture(std::size_t image, const std::array<Wrap, 2>& wrap) {
  const Json& from = file_.item("images", image);
  const std::string uri = text_in(from, "uri");
  std::string name = fmt::format("images[{}]", image);
  if (const std::string given = text_in(from, "name"); !given.empty()) name += " " + given;
  if (uri.starts_with("data:")) {
    return textures_.of(name, bytes_of_data_uri(uri).value_or(""), wrap);
  }
  if (!uri.empty()) return textures_.at(uri, wrap);
  const auto view = file_.index(from, "bufferView", "bufferViews");
  return textures_.of(name, view ? file_.view(*view) : "", wrap);
}

std::vector<CornerLook> GltfLooks::of_vertices(const Json& attributes, std::size_t material,
                                               std::size_t vertices) {
  std::vector<CornerLook> out;
  const auto add = [&](const std::string& name, const auto& read) {
    attempt([&] {
      const auto accessor = file_.index(attributes, name.c_str(), "accessors");
      if (!accessor) return;
      out.resize(vertices);
      read(*accessor);
    });
  };
  const Placing& placing = placings_[material];
  if (placing.is_used || keeps_uvs_) {
    add(fmt::format("TEXCOORD_{}", placing.set),
        [&](std::size_t accessor) { add_uvs(accessor, placing, out); });
  }
  add("COLOR_0", [&](std::size_t accessor) { add_colours(accessor, out); });
  return out;
}

void GltfLooks::add_uvs(std::size_t accessor, const Placing& placing, std::vector<CornerLook>& to) {
  const GltfNumbers uvs = file_.numbers(accessor, 2);
  for (std::size_t i = 0; i < std::min(to.size(), uvs.rows()); ++i) {
    const Eigen::Vector3d uv(uvs.row(i)[0], uvs.row(i)[1], 1.0);
    to[i].uv = (placing.T * uv).cast<float>();
  }
}

/// Linear; integers are shares, even where their accessor forgets to say so.
void GltfLooks::add_colours(std::size_t accessor, std::vector<CornerLook>& to) {
  constexpr std::size_t kByte = 5121, kShort = 5123;
  const Json& from = file_.item("accessors", accessor);
  const GltfNumbers colours = file_.numbers(accessor, text_in(from, "type") == "VEC4" ? 4 : 3);
  const std::size_t component = file_.size(from, "componentType", 0);
  const bool is_share = from.contains("normalized") && from["normalized"] == true;
  const double full = is_share              ? 1.0
                      : component == kByte  ? 255.0
                      : component == kShort ? 65535.0
                                            : 1.0;
  for (std::size_t i = 0; i < std::min(to.size(), colours.rows()); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = colours.row(i)[k] / full;
      to[i].tint[k] = srgb_byte(value > 0.0 ? static_cast<float>(std::min(value, 1.0)) : 0.0F);
    }
  }
}

void GltfLooks::warn(std::vector<std::string>& warnings) const {
  textures_.warn(warnings);
  warnings.insert(warnings.end(), faults_.begin(), faults_.end());
}

}  // namespace gnbv
