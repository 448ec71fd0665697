#include "tools/report/packed_json.hpp"

#include "tools/scene/looks.hpp"

namespace gnbv {

using Json = nlohmann::ordered_json;

namespace {

/// By their numbers.
Json reasons_json() {
  Json reasons = Json::array();
  for (const RejectionLook& look : rejection_looks())
    reasons.push_back({{"words", look.words}, {"colour", look.light}});
  return reasons;
}

Json candidates_json(const PackedCandidates& packed) {
  return {{"points", points_json(packed.points)}, {"angles", slice_json(packed.angles_rad)},
          {"kind", slice_json(packed.kind)},      {"terms", slice_json(packed.terms)},
          {"begins", slice_json(packed.begins)},  {"reasons", reasons_json()}};
}

Json beliefs_json(const PackedBeliefs& packed, double map_m) {
  Json json = {
      {"size_m", packed.size_m}, {"map_m", map_m}, {"low", packed.low}, {"cells", packed.cells}};
  for (std::size_t i = 0; i < kBeliefLists.size(); ++i) {
    const auto& list = packed.lists[i];
    json[kBeliefLists[i].name] = !list ? Json(nullptr)
                                       : Json{{"runs", slice_json(list->runs)},
                                              {"begins", slice_json(list->begins)},
                                              {"counts", slice_json(list->counts)}};
  }
  return json;
}

}  // namespace

Json slice_json(const ByteSlice& slice) { return {slice.at, slice.count}; }

Json vector_json(const Vec3f& v) { return {v.x(), v.y(), v.z()}; }

Json points_json(const PackedPoints& points) {
  return {{"min", vector_json(points.min_m)},
          {"size", vector_json(points.size_m)},
          {"steps", slice_json(points.steps)}};
}

Json packed_json(const PackedRun& packed, double map_m) {
  Json json = {{"cloud", nullptr},   {"voxels", nullptr}, {"path", nullptr},
               {"plan", nullptr},    {"found", nullptr},  {"candidates", nullptr},
               {"beliefs", nullptr}, {"surface", nullptr}};
  if (packed.cloud) {
    json["cloud"] = {{"points", points_json(packed.cloud->points)},
                     {"after", slice_json(packed.cloud->after)},
                     {"all_points", packed.cloud->all_points},
                     {"cell_m", packed.cloud->cell_m}};
    if (packed.cloud->error) json["cloud"]["error"] = slice_json(*packed.cloud->error);
    if (packed.cloud->colour) json["cloud"]["colour"] = slice_json(*packed.cloud->colour);
  }
  if (packed.voxels) {
    json["voxels"] = {{"size_m", packed.voxels->size_m},
                      {"index", slice_json(packed.voxels->index)},
                      {"after", slice_json(packed.voxels->after)},
                      {"gain_step", slice_json(packed.voxels->gain_step)},
                      {"gain_points", slice_json(packed.voxels->gain_points)},
                      {"gains_after", slice_json(packed.voxels->gains_after)}};
  }
  if (packed.path) {
    json["path"] = {{"points", points_json(packed.path->points)},
                    {"time", slice_json(packed.path->time_s)},
                    {"quaternion", slice_json(packed.path->quaternion)}};
  }
  if (packed.plan) {
    json["plan"] = {{"poses", slice_json(packed.plan->poses)},
                    {"ranges", slice_json(packed.plan->ranges)}};
  }
  if (packed.candidates) json["candidates"] = candidates_json(*packed.candidates);
  if (packed.beliefs) json["beliefs"] = beliefs_json(*packed.beliefs, map_m);
  if (packed.found) json["found"] = slice_json(*packed.found);
  if (packed.surface) json["surface"] = slice_json(*packed.surface);
  Json frames = Json::array();
  for (const PackedThumbnail& t : packed.thumbnails) {
    frames.push_back({t.view, packed.cameras[t.camera], t.width_px, t.height_px, t.jpeg.at,
                      t.jpeg.count, t.depth_jpeg.at, t.depth_jpeg.count});
  }
  json["frames"] = frames;
  return json;
}

}  // namespace gnbv
