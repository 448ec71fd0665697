#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "assets/catalog.hpp"
#include "assets/random/random_structure.hpp"
#include "scenarios/scenario.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRandom = "random";

struct AssetOptions {
  std::string name;
  std::optional<std::uint64_t> seed;  // of a random one
  std::string kind;                   // of it; empty: the seed chooses
  std::string drawn_from;             // what its seed is drawn from, instead of --seed
  int draw = 1;                       // which of the draws
  fs::path out;
  bool list = false;
  bool json = false;
};

/// The built-in ones, and random ones.
std::vector<std::string> structure_names() {
  std::vector<std::string> names(kStructureNames.begin(), kStructureNames.end());
  names.emplace_back(kRandom);
  return names;
}

void check(const AssetOptions& options) {
  if (options.name.empty()) {
    throw BadInput("asset: NAME is missing; it is one of {}", fmt::join(structure_names(), ", "));
  }
  const bool is_drawn = !options.drawn_from.empty();
  if (options.name != kRandom && (options.seed || !options.kind.empty() || is_drawn)) {
    throw BadInput("{}: --seed, --kind and --drawn-from are for `asset random`", options.name);
  }
  if (is_drawn && options.kind.empty()) throw BadInput("--drawn-from: needs --kind");
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
    nlohmann::ordered_json facts = {
        {"name", options.name},
        {"files", files},
        {"vertices", mesh.vertices_m.size()},
        {"faces", mesh.faces.size()},
        {"materials", mesh.materials.size()},
        {"area_m2", surface_area_m2(mesh)},
        {"bounds_m", {{"min", {lo.x(), lo.y(), lo.z()}}, {"max", {hi.x(), hi.y(), hi.z()}}}}};
    if (options.name == kRandom) facts.update({{"kind", options.kind}, {"seed", *options.seed}});
    return fmt::print("{}\n",
                      facts.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }
  for (const std::string& file : files) fmt::print("{}\n", file);
  if (options.name == kRandom) {
    fmt::print("random {}, seed {}\n", options.kind, *options.seed);
  }
  fmt::print("{} vertices, {} faces, {} materials, {:.0f} m2\n", mesh.vertices_m.size(),
             mesh.faces.size(), mesh.materials.size(), surface_area_m2(mesh));
  fmt::print("x {:.2f} to {:.2f}, y {:.2f} to {:.2f}, z {:.2f} to {:.2f} m\n", lo.x(), hi.x(),
             lo.y(), hi.y(), lo.z(), hi.z());
}

void print_list(bool json) {
  if (json) {
    const nlohmann::ordered_json all = {{"structures", structure_names()},
                                        {"random_kinds", kRandomKinds}};
    return fmt::print("{}\n", all.dump());
  }
  for (const std::string_view name : kStructureNames) fmt::print("{}\n", name);
  for (const std::string_view kind : kRandomKinds) fmt::print("{} --kind {}\n", kRandom, kind);
}

/// Fills in what of a random one was not given.
TriangleMesh make(AssetOptions& options) {
  if (options.name != kRandom) return make_builtin_structure(options.name);
  options.seed = options.drawn_from.empty()
                     ? options.seed.value_or(1)
                     : drawn_seed(options.drawn_from, options.kind, options.draw);
  if (options.kind.empty()) options.kind = random_kind(*options.seed);
  return make_random_structure(*options.seed, options.kind);
}

void asset(AssetOptions options) {
  if (options.list) return print_list(options.json);
  check(options);
  const TriangleMesh mesh = make(options);
  write_mesh(mesh, options.out);
  print_facts(options, mesh);
}

}  // namespace

void add_asset_command(CLI::App& app) {
  auto options = std::make_shared<AssetOptions>();
  CLI::App* const command =
      app.add_subcommand("asset", "write a built-in or a random structure as a mesh file");
  CLI::Option* const name =
      command->add_option("NAME", options->name, "structure, or `random`; --list names them")
          ->check(is_one_of(structure_names()));
  CLI::Option* const out = command->add_option(
      "-o,--out", options->out,
      "file to write: .obj (with its .mtl), .ply or .glb; metres, z up (.glb: y up)");
  CLI::Option* const seed = command->add_option(
      "--seed", options->seed, "of `random`: number of the structure (default: 1)");
  CLI::Option* const kind =
      command
          ->add_option("--kind", options->kind,
                       "of `random`: hall, tower, ... (--list names them; default: by the seed)")
          ->check(is_one_of({kRandomKinds.begin(), kRandomKinds.end()}));
  CLI::Option* const drawn =
      command
          ->add_option(
              "--drawn-from", options->drawn_from,
              "of `random`: a text, such as a commit. Its SHA-256, with --kind and --draw, is the "
              "seed. So nobody can have tuned to the structure before the commit was made")
          ->excludes(seed);
  command->add_option("--draw", options->draw, "of --drawn-from: number of the draw (default: 1)")
      ->needs(drawn)
      ->check(CLI::Range(1, 1'000'000));
  CLI::Option* const list =
      command->add_flag("--list", options->list, "print the names of the structures");
  for (CLI::Option* const other : {name, out, seed, kind, drawn}) list->excludes(other);
  command->add_flag("--json", options->json, "print JSON instead of text");
  command->callback([options] { asset(*options); });
}

}  // namespace gnbv
