#include <map>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/reference.hpp"
#include "tools/page/packs.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kAllMeshBytes = 4'000'000;
constexpr std::size_t kAllSurfaceBytes = 6'000'000;
constexpr std::size_t kVoxelBytes = 6;
constexpr std::size_t kFoundBytes = 2;  // a voxel and run
constexpr std::size_t kMaxFaces = 120'000;
constexpr std::size_t kPaintedFaces = 40'000;  // of a structure with pictures
constexpr std::size_t kFewFaces = 100;         // are never too many

/// Equal for runs of the same structure among the same obstacles on the same terrain, that are
/// scored alike.
std::string structure_key(const Scenario& scenario) {
  Scenario only;
  only.structure = scenario.structure;
  only.terrain = scenario.terrain;
  only.obstacles = scenario.obstacles;
  only.score = what_a_ceiling_depends_on(scenario).score;
  only.planner.floor_z_m = scenario.planner.floor_z_m;
  return to_yaml(only);
}

/// What stands there, as one mesh.
TriangleMesh all_meshes(const World& world) {
  TriangleMesh all = world.structure;
  for (const TriangleMesh* more : {&world.obstacles, &world.terrain}) {
    if (!more->faces.empty()) append(all, *more);
  }
  return all;
}

std::shared_ptr<KnownStructure> known_structure(const Scenario& scenario, std::size_t max_voxels,
                                                int threads) {
  std::vector<std::string> told_by_run;  // the mesh's faults were told when it was flown
  auto known = std::make_shared<KnownStructure>(load_world_anywhere(scenario, told_by_run));
  try {
    const auto reference = reference_of(scenario, known->world, known->scene, threads);
    known->to_find = true_voxels(reference, max_voxels);
  } catch (const BadInput&) {
    // nothing to measure: there is nothing to find
  }
  return known;
}

/// int16 (n, 3): the voxel covers [index, index + 1) * size.
std::vector<std::int16_t> voxel_indices(const TrueVoxels& voxels) {
  std::vector<std::int16_t> indices;
  for (const std::uint64_t code : voxels.codes) {
    for (const std::int64_t k : index_of(code)) indices.push_back(static_cast<std::int16_t>(k));
  }
  return indices;
}

/// None where the run was flown around another one.
Structures::OfRun as_flown(const Structures::OfRun& structure, const RunRecord& record) {
  try {
    need_same_inputs(record.folder, structure.inputs, "the page shows the run without it");
    return structure;
  } catch (const BadInput& error) {
    return {.number = -1, .why = error.what()};
  }
}

page::MeshData pack_whole(const TriangleMesh& mesh, VertexColours& colours, page::Arrays& arrays) {
  page::MeshData out{.vertices = arrays.add_points(mesh.vertices_m)};
  if (!colours.empty()) out.colours = arrays.add<3>(colours.of(mesh.vertices_m));
  std::vector<std::vector<std::uint32_t>> corners(mesh.materials.size());
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    auto& of_part = corners[material_of(mesh, i)];
    of_part.insert(of_part.end(), mesh.faces[i].begin(), mesh.faces[i].end());
  }
  for (std::size_t m = 0; m < corners.size(); ++m) {
    if (corners[m].empty()) continue;
    const Material& material = mesh.materials[m];
    page::MeshPart part{.rgb = {}, .corners = arrays.add<3>(corners[m])};
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_plain = material.pattern == Pattern::plain;
      part.rgb[k] = is_plain ? material.rgb[k] : 0.7F * material.rgb[k] + 0.3F * material.rgb_2[k];
      if (out.colours) part.rgb[k] = 1.0;
    }
    out.parts.push_back(part);
  }
  return out;
}

}  // namespace

page::MeshData pack_mesh(const TriangleMesh& mesh, std::size_t max_bytes, page::Arrays& arrays) {
  const std::size_t before = arrays.bytes().size();
  const TriangleMesh whole = cut_finer(mesh, kPaintedFaces, kMaxFaces);
  VertexColours colours(whole);
  for (TriangleMesh small = with_fewer_faces(whole, kMaxFaces);;
       small = with_fewer_faces(mesh, small.faces.size() / 4 * 3)) {
    page::MeshData out = pack_whole(small, colours, arrays);
    out.all_faces = mesh.faces.size();
    const bool fits = arrays.bytes().size() - before <= max_bytes;
    if (fits || small.faces.size() <= kFewFaces) return out;
    arrays.cut(before);
  }
}

namespace {

/// The bodies that move around a structure.
void pack_movers(const Structures::OfRun& structure, std::size_t max_bytes, page::Arrays& arrays,
                 std::vector<page::MoverData>& movers) {
  for (const MovingBody& body : structure.known->world.movers) {
    page::MoverData& mover = movers.emplace_back();
    mover.mesh = structure.number;
    mover.shape = pack_mesh(body.mesh, max_bytes, arrays);
    for (const Vec3& m : body.motion.corners_m()) mover.way.push_back({m.x(), m.y(), m.z()});
    mover.speed_m_s = body.motion.speed_m_s;
    mover.is_loop = body.motion.loop;
  }
}

}  // namespace

Structures pack_structures(const std::vector<RunRecord>& records, int threads,
                           page::Arrays& arrays) {
  std::map<std::string, Structures::OfRun> known;
  for (const RunRecord& record : records) known[structure_key(record.scenario)] = {};
  const std::size_t max_bytes = kAllMeshBytes / known.size();
  const std::size_t max_voxels =
      kAllSurfaceBytes / (kVoxelBytes * known.size() + kFoundBytes * records.size());
  known.clear();
  Structures out;
  for (const RunRecord& record : records) {
    const auto [entry, is_new] = known.try_emplace(structure_key(record.scenario));
    Structures::OfRun& structure = entry->second;
    try {
      if (is_new) {
        structure.known = known_structure(record.scenario, max_voxels, threads);
        structure.inputs = world_inputs(record.scenario, structure.known->world);
        structure.number = static_cast<int>(out.meshes.size());
        out.meshes.push_back(pack_mesh(all_meshes(structure.known->world), max_bytes, arrays));
        pack_movers(structure, max_bytes, arrays, out.movers);
        if (const TrueVoxels& voxels = structure.known->to_find; !voxels.codes.empty()) {
          out.meshes.back().surface = {.size_m = voxels.size_m,
                                       .index = arrays.add<3>(voxel_indices(voxels))};
        }
      }
    } catch (const BadInput& error) {
      structure.why = error.what();
    }
    out.of_run.push_back(as_flown(structure, record));
  }
  return out;
}

}  // namespace gnbv
