// The built-in structures by name. Their files are in this folder: an OBJ file with its MTL for
// each, and one table of solid textures for all. The program holds their contents.
#pragma once

#include <string_view>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// What a structure is read from. Messages call the texts assets/NAME.obj, assets/NAME.mtl and
/// assets/materials.yaml.
struct StructureTexts {
  std::string_view name;
  std::string_view obj, mtl;   // vertices in metres, z up
  std::string_view materials;  // a map of structures, each a map of its materials
};

/// "aircraft", "power_plant", "lab_model", "lab_airplane" or "smoke". Requires a known name:
/// scenarios are checked against the same list.
StructureTexts builtin_structure_texts(std::string_view name);

/// Triangles and vertices have the order of the OBJ text, materials that of the table. Throws
/// BadInput naming the file, its line and its fault where a text is damaged.
TriangleMesh read_structure(const StructureTexts& texts);

/// The built-in structure of that name.
TriangleMesh make_builtin_structure(std::string_view name);

}  // namespace gnbv
