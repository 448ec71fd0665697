// What the page is told about runs: JSON beside the blocks of bytes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/compare/text_table.hpp"
#include "sim/mesh/triangle_mesh.hpp"
#include "tools/report/run_pack.hpp"
#include "tools/report/true_surface.hpp"

namespace gnbv {

/// Title, columns, rows and notes as printed.
nlohmann::ordered_json table_json(const TextTable& table);

/// The structure, thinned until its arrays, which are added to `bytes`, take at most `max_bytes`.
nlohmann::ordered_json mesh_json(const TriangleMesh& mesh, std::size_t max_bytes, BytePack& bytes);

/// Null where there is nothing to find.
nlohmann::ordered_json true_voxels_json(const TrueVoxels& voxels, BytePack& bytes);

/// The record with what was packed of it. `mesh` is the page's number of its structure, -1 for
/// none.
nlohmann::ordered_json run_json(const RunRecord& record, const std::string& label,
                                const PackedRun& packed, int mesh);

}  // namespace gnbv
