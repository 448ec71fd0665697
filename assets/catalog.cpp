#include "assets/catalog.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenarios/document.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/values.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/error.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

GNBV_EMBED(materials_yaml, GNBV_ASSETS_FOLDER "/materials.yaml");
GNBV_EMBED(aircraft_obj, GNBV_ASSETS_FOLDER "/aircraft.obj");
GNBV_EMBED(aircraft_mtl, GNBV_ASSETS_FOLDER "/aircraft.mtl");
GNBV_EMBED(power_plant_obj, GNBV_ASSETS_FOLDER "/power_plant.obj");
GNBV_EMBED(power_plant_mtl, GNBV_ASSETS_FOLDER "/power_plant.mtl");
GNBV_EMBED(lab_model_obj, GNBV_ASSETS_FOLDER "/lab_model.obj");
GNBV_EMBED(lab_model_mtl, GNBV_ASSETS_FOLDER "/lab_model.mtl");
GNBV_EMBED(lab_airplane_obj, GNBV_ASSETS_FOLDER "/lab_airplane.obj");
GNBV_EMBED(lab_airplane_mtl, GNBV_ASSETS_FOLDER "/lab_airplane.mtl");
GNBV_EMBED(smoke_obj, GNBV_ASSETS_FOLDER "/smoke.obj");
GNBV_EMBED(smoke_mtl, GNBV_ASSETS_FOLDER "/smoke.mtl");

struct Entry {
  std::string_view name;
  std::string_view (*obj)();
  std::string_view (*mtl)();
};
constexpr std::array kCatalog = {Entry{"aircraft", aircraft_obj, aircraft_mtl},
                                 Entry{"power_plant", power_plant_obj, power_plant_mtl},
                                 Entry{"lab_model", lab_model_obj, lab_model_mtl},
                                 Entry{"lab_airplane", lab_airplane_obj, lab_airplane_mtl},
                                 Entry{"smoke", smoke_obj, smoke_mtl}};
static_assert(std::ranges::equal(kCatalog, kStructureNames, {}, &Entry::name));

constexpr std::string_view kTable = "assets/materials.yaml";
constexpr std::array<std::string_view, 6> kPatterns = {"plain",  "noise",   "panels",
                                                       "bricks", "stripes", "checker"};  // in order

std::string obj_name(const StructureTexts& texts) {
  return fmt::format("assets/{}.obj", texts.name);
}

/// The material without its first colour.
Material textured(const YamlEntry& entry, const std::string& path, ValidationErrors& errors) {
  constexpr std::array<std::string_view, 3> kKeys = {"pattern", "rgb_2", "pattern_size_m"};
  for (const YamlEntry& given : entry.value.entries) {
    if (std::ranges::find(kKeys, given.key) != kKeys.end()) continue;
    errors.add(given.location, path + '.' + given.key, "",
               fmt::format("is no known key ({}known here: {})", did_you_mean(given.key, kKeys),
                           join(kKeys)));
  }
  const auto read = [&](std::string_view key, const FieldValue& value, const Range& allowed,
                        std::span<const std::string_view> choices = {}) {
    const std::string key_path = fmt::format("{}.{}", path, key);
    const YamlNode* const node = entry.value.find(key);
    if (node == nullptr) return errors.add(entry.location, key_path, "", "is missing");
    Field field;
    field.allowed = allowed;
    field.choices = choices;
    for (const ValueError& error : read_value(*node, field, "", value)) {
      errors.add(node->location, key_path + error.item, excerpt(*error.node), error.what);
    }
  };
  std::string pattern(kPatterns[0]);
  Vec3 rgb_2 = Vec3::Zero();
  double size_m = 0.0;
  read(kKeys[0], &pattern, {}, kPatterns);
  read(kKeys[1], &rgb_2, {0.0, 1.0});
  read(kKeys[2], &size_m, positive(100.0));
  Material material{.name = entry.key};
  material.pattern =
      static_cast<Pattern>(std::ranges::find(kPatterns, pattern) - kPatterns.begin());
  Vec3f::Map(material.rgb_2.data()) = rgb_2.cast<float>();
  material.pattern_size_m = static_cast<float>(size_m);
  return material;
}

/// Replaces the materials by those of the table, which keep the colours.
void take_textures(const YamlNode& table, const StructureTexts& texts, TriangleMesh& mesh,
                   ValidationErrors& errors) {
  std::vector<std::optional<std::size_t>> number_of(mesh.materials.size());
  std::vector<Material> materials;
  for (const YamlEntry& entry : table.entries) {
    const std::string path = fmt::format("{}.{}", texts.name, entry.key);
    const auto used = std::ranges::find(mesh.materials, entry.key, &Material::name);
    if (used == mesh.materials.end()) {
      errors.add(entry.location, path, "", "no face of " + obj_name(texts) + " has this material");
      continue;
    }
    number_of[static_cast<std::size_t>(used - mesh.materials.begin())] = materials.size();
    materials.push_back(textured(entry, path, errors));
    materials.back().rgb = used->rgb;
  }
  for (std::size_t i = 0; i < number_of.size(); ++i) {
    if (number_of[i]) continue;
    errors.add(table.location, fmt::format("{}.{}", texts.name, mesh.materials[i].name), "",
               "is missing: faces of " + obj_name(texts) + " have this material");
  }
  errors.throw_if_any();
  mesh.materials = std::move(materials);
  for (std::uint16_t& m : mesh.face_material) m = static_cast<std::uint16_t>(*number_of[m]);
}

/// The part of the table that is this structure's.
YamlNode textures_of(const StructureTexts& texts, ValidationErrors& errors) {
  const SourceLocation start = {std::string(kTable), 1, 0};
  const auto root = parse_document(std::string(texts.materials), start, errors);
  errors.throw_if_any();
  const YamlNode* const table = root->find(texts.name);
  if (table == nullptr) errors.add(start, texts.name, "", "is missing");
  errors.throw_if_any();
  return *table;
}

}  // namespace

StructureTexts builtin_structure_texts(std::string_view name) {
  const auto* const entry = std::ranges::find(kCatalog, name, &Entry::name);
  GNBV_CHECK(entry != kCatalog.end(), "no structure is called '{}'", name);
  return {name, entry->obj(), entry->mtl(), materials_yaml()};
}

TriangleMesh read_structure(const StructureTexts& texts) {
  std::vector<std::string> faults;
  PolygonMesh polygons = read_obj_text(obj_name(texts), texts.obj, texts.mtl, faults);
  if (!polygons.not_finite.empty()) faults.push_back(polygons.not_finite);
  if (polygons.face_ends.empty()) faults.push_back(obj_name(texts) + ": holds no faces");
  if (!faults.empty()) throw BadInput(faults.front());
  ValidationErrors errors;
  const YamlNode table = textures_of(texts, errors);
  TriangleMesh mesh = triangulated(std::move(polygons));
  take_textures(table, texts, mesh, errors);
  return mesh;
}

TriangleMesh make_builtin_structure(std::string_view name) {
  return read_structure(builtin_structure_texts(name));
}

}  // namespace gnbv
