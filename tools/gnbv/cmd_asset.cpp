#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "assets/catalog.hpp"
#include "scenarios/faults.hpp"
#include "scenarios/scenario.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tools/gnbv/commands.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct AssetOptions {
  std::string name;
  fs::path out;
  bool list = false;
  bool json = false;
};

void check(const AssetOptions& options) {
  const auto& known = kStructureNames;
  if (std::find(known.begin(), known.end(), options.name) == known.end()) {
    const auto near = nearest_name(options.name, known, slip_limit(options.name));
    throw BadInput(fmt::format("{}: no built-in structure ({}they are: {})",
                               options.name.empty() ? "asset" : options.name,
                               near ? fmt::format("did you mean '{}'? ", *near) : "", join(known)));
  }
  if (options.out.empty()) {
    throw BadInput("asset: -o FILE is missing; its extension, .obj, .ply or .glb, is the format");
  }
}

/// The files that the writer made, the mesh first.
std::vector<std::string> files_of(const fs::path& out) {
  std::vector<std::string> files = {out.string()};
  if (extension_of(out) == ".obj")
    files.push_back(fs::path(out).replace_extension(".mtl").string());
  return files;
}

void print_facts(const AssetOptions& options, const TriangleMesh& mesh) {
  const std::vector<std::string> files = files_of(options.out);
  const Box3 box = bounds_m(mesh);
  const Vec3 lo = box.min();
  const Vec3 hi = box.max();
  if (options.json) {
    const nlohmann::ordered_json facts = {
        {"name", options.name},
        {"files", files},
        {"vertices", mesh.vertices_m.size()},
        {"faces", mesh.faces.size()},
        {"materials", mesh.materials.size()},
        {"area_m2", surface_area_m2(mesh)},
        {"bounds_m", {{"min", {lo.x(), lo.y(), lo.z()}}, {"max", {hi.x(), hi.y(), hi.z()}}}}};
    fmt::print("{}\n", facts.dump(2));
    return;
  }
  for (const std::string& file : files) fmt::print("{}\n", file);
  fmt::print("{} vertices, {} faces, {} materials, {:.0f} m2\n", mesh.vertices_m.size(),
             mesh.faces.size(), mesh.materials.size(), surface_area_m2(mesh));
  fmt::print("x {:.2f} to {:.2f}, y {:.2f} to {:.2f}, z {:.2f} to {:.2f} m\n", lo.x(), hi.x(),
             lo.y(), hi.y(), lo.z(), hi.z());
}

void asset(const AssetOptions& options) {
  if (options.list) {
    if (options.json) {
      fmt::print("{}\n", nlohmann::json(kStructureNames).dump());
    } else {
      for (const std::string_view name : kStructureNames) fmt::print("{}\n", name);
    }
    return;
  }
  check(options);
  const TriangleMesh mesh = make_builtin_structure(options.name);
  write_mesh(mesh, options.out);
  print_facts(options, mesh);
}

}  // namespace

void add_asset_command(CLI::App& app) {
  auto options = std::make_shared<AssetOptions>();
  CLI::App* const command =
      app.add_subcommand("asset", "write a built-in structure as a mesh file");
  CLI::Option* const name =
      command->add_option("NAME", options->name, "structure; --list names them");
  CLI::Option* const out = command->add_option(
      "-o,--out", options->out,
      "file to write: .obj (with its .mtl), .ply or .glb; metres, z up (.glb: y up)");
  command->add_flag("--list", options->list, "print the names of the structures")
      ->excludes(name)
      ->excludes(out);
  command->add_flag("--json", options->json, "print JSON instead of text");
  command->callback([options] { asset(*options); });
}

}  // namespace gnbv
