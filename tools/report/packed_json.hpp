// Where in its block of bytes each array of a run lies, as the page reads it (data.ts).
#pragma once

#include <nlohmann/json.hpp>

#include "tools/report/run_pack.hpp"

namespace gnbv {

nlohmann::ordered_json slice_json(const ByteSlice& slice);
nlohmann::ordered_json vector_json(const Vec3f& v);
nlohmann::ordered_json points_json(const PackedPoints& points);

/// Of all that there is; null for what there is not. `map_m`: edge of the map's voxels.
nlohmann::ordered_json packed_json(const PackedRun& packed, double map_m);

}  // namespace gnbv
