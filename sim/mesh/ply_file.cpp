// The PLY readers of sim/mesh/polygon_mesh.hpp.
#include <algorithm>

#include "sim/mesh/ply_reader.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

using Columns = std::array<std::size_t, 3>;  // into an item

/// The properties of these names that are no lists, the last of each name; or the 0.
Columns columns_of(const PlyElement& element, const std::array<std::string_view, 3>& names) {
  const std::size_t count = element.properties.size();
  Columns found = {count, count, count};
  for (std::size_t i = 0; i < count; ++i) {
    const PlyProperty& property = element.properties[i];
    std::string_view name = property.name;
    if (name.starts_with("diffuse_")) name.remove_prefix(8);  // as some call their colours
    for (std::size_t k = 0; k < 3; ++k) {
      if (property.count_type == nullptr && name == names[k]) found[k] = i;
    }
  }
  return found;
}

Vec3 three_of(const PlyItem& item, const Columns& columns) {
  return {item[columns[0]][0], item[columns[1]][0], item[columns[2]][0]};
}

/// For the colours of an element that has all three channels.
std::optional<LevelColours> colours_for(const PlyElement& element, const Columns& rgb) {
  if (std::ranges::count(rgb, element.properties.size()) > 0) return std::nullopt;
  const double full = element.properties[rgb[0]].type->full;
  return LevelColours(std::min(full, 255.0), std::max(full, 255.0));
}

Columns xyz_of(const PlyFile& ply, const PlyElement& element) {
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  const Columns xyz = columns_of(element, kNames);
  for (std::size_t k = 0; k < 3; ++k) {
    if (xyz[k] == element.properties.size()) {
      ply.fail(fmt::format("its vertices have no property '{}'", kNames[k]));
    }
  }
  return xyz;
}

void read_vertices(PlyFile& ply, const PlyElement& element, PolygonMesh& out) {
  const Columns xyz = xyz_of(ply, element);
  const Columns rgb = columns_of(element, {"red", "green", "blue"});
  auto colours = colours_for(element, rgb);
  out.vertices.reserve(out.vertices.size() + ply.most_items(element));
  std::uint64_t i = 0;  // within the element
  ply.for_each_item(element, [&](const PlyItem& item) {
    const Vec3 p = three_of(item, xyz);
    if (!p.allFinite() && out.not_finite.empty()) {
      out.not_finite =
          fmt::format("{}: vertex {} is at ({}, {}, {})", ply.path(), i, p.x(), p.y(), p.z());
    }
    ++i;
    as_index(out.vertices.size(), ply.path(), "vertices");
    out.vertices.push_back(p);
    if (colours) colours->add(three_of(item, rgb));
  });
  if (colours) out.vertex_rgb = std::move(colours->rgb);
}

std::uint32_t corner_from(double vertex) {
  return vertex >= 0.0 && vertex < kNoVertex ? static_cast<std::uint32_t>(vertex) : kNoVertex;
}

/// Which of an element's properties list corners. Refuses an element whose lists do not.
std::vector<std::size_t> corner_lists_of(const PlyFile& ply, const PlyElement& element) {
  std::vector<std::size_t> lists;
  std::string others;
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    if (property.is_corners()) lists.push_back(k);
    if (property.count_type != nullptr) others += fmt::format(" '{}'", property.name);
  }
  if (lists.empty() && element.count > 0) {
    ply.fail(fmt::format("its element '{}' lists{}, not vertex_indices", element.name,
                         others.empty() ? " nothing" : others));
  }
  return lists;
}

/// Each strip's triangles turn in the same sense; -1 begins another strip.
void read_strips(PlyFile& ply, const PlyElement& element, PolygonMesh& out) {
  const std::vector<std::size_t> lists = corner_lists_of(ply, element);
  ply.for_each_item(element, [&](const PlyItem& item) {
    for (const std::size_t k : lists) {
      std::size_t length = 0;
      for (std::size_t i = 0; i < item[k].size(); ++i) {
        length = item[k][i] == -1.0 ? 0 : length + 1;
        if (length < 3) continue;
        const bool is_odd = length % 2 == 0;
        for (const std::size_t back : {is_odd ? 1U : 2U, is_odd ? 2U : 1U, 0U}) {
          out.corners.push_back(corner_from(item[k][i - back]));
        }
        out.face_ends.push_back(as_index(out.corners.size(), ply.path(), "corners"));
      }
    }
  });
}

/// Takes vertices of any number: a file may list the vertices after the faces.
void read_faces(PlyFile& ply, const PlyElement& element, PolygonMesh& out,
                std::vector<std::uint32_t>& face_rgb) {
  const Columns rgb = columns_of(element, {"red", "green", "blue"});
  auto colours = colours_for(element, rgb);
  const std::vector<std::size_t> lists = corner_lists_of(ply, element);
  out.face_ends.reserve(out.face_ends.size() + ply.most_items(element));
  out.corners.reserve(out.corners.size() + 3 * ply.most_items(element));
  ply.for_each_item(element, [&](const PlyItem& item) {
    for (const std::size_t k : lists) {
      for (const double vertex : item[k]) out.corners.push_back(corner_from(vertex));
      out.face_ends.push_back(as_index(out.corners.size(), ply.path(), "corners"));
    }
    if (colours) colours->add(three_of(item, rgb));
  });
  if (colours) face_rgb = std::move(colours->rgb);
}

/// Drops faces of fewer than three corners or of vertices that do not exist, with their colours.
/// Returns how many.
std::size_t drop_impossible_faces(PolygonMesh& mesh, std::vector<std::uint32_t>& face_rgb) {
  std::size_t faces = 0, corners = 0, begin = 0;  // of those that are kept
  for (std::size_t i = 0; i < mesh.face_ends.size(); ++i) {
    const auto face = std::span(mesh.corners).subspan(begin, mesh.face_ends[i] - begin);
    begin = mesh.face_ends[i];
    if (face.size() < 3 || *std::max_element(face.begin(), face.end()) >= mesh.vertices.size()) {
      continue;
    }
    std::copy(face.begin(), face.end(),
              mesh.corners.begin() + static_cast<std::ptrdiff_t>(corners));
    corners += face.size();
    if (!face_rgb.empty()) face_rgb[faces] = face_rgb[i];
    mesh.face_ends[faces++] = static_cast<std::uint32_t>(corners);
  }
  const std::size_t dropped = mesh.face_ends.size() - faces;
  mesh.face_ends.resize(faces);
  mesh.corners.resize(corners);
  if (!face_rgb.empty()) face_rgb.resize(faces);
  return dropped;
}

}  // namespace

PolygonMesh read_ply(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  PlyFile ply(path);
  if (!ply.picture().empty()) {
    warnings.push_back(fmt::format("{}: its picture {} is not read: of PLY, plain colours are",
                                   ply.path(), ply.picture().substr(0, 100)));
  }
  PolygonMesh out;
  std::vector<std::uint32_t> face_rgb;  // 0xrrggbb in sRGB
  const auto is_shape = [](const PlyElement& element) {
    return element.name == "vertex" || element.name == "face" || element.name == "tristrips";
  };
  const std::vector<PlyElement>& all = ply.elements();
  const auto last = std::find_if(all.rbegin(), all.rend(), is_shape).base();
  for (auto at = all.begin(); at != last || (ply.is_free() && at != all.end()); ++at) {
    const PlyElement& element = *at;
    if (element.name == "vertex") {
      read_vertices(ply, element, out);
    } else if (element.name == "face") {
      read_faces(ply, element, out, face_rgb);
    } else if (element.name == "tristrips") {
      read_strips(ply, element, out);
    } else {
      ply.for_each_item(element, [](const PlyItem&) {});
    }
  }
  if (last == all.end() || ply.is_free()) out.lost_faces = ply.warn_of_rest(warnings);
  if (face_rgb.size() != out.face_ends.size()) face_rgb.clear();
  if (const std::size_t dropped = drop_impossible_faces(out, face_rgb); dropped > 0) {
    out.lost_faces += dropped;
    warnings.push_back(
        fmt::format("{}: {} faces of vertices that do not exist left out", ply.path(), dropped));
  }
  if (!face_rgb.empty()) take_colours(face_rgb, out.materials, out.face_material);
  if (!face_rgb.empty() || out.vertex_rgb.size() != out.vertices.size()) out.vertex_rgb.clear();
  return out;
}

std::vector<Vec3f> read_ply_points(const std::filesystem::path& path, const Vec3& offset_m,
                                   std::vector<std::string>& warnings) {
  PlyFile ply(path);
  std::vector<Vec3f> points;
  const std::vector<PlyElement>& all = ply.elements();
  const auto is_points = [](const PlyElement& element) {
    return element.name == "vertex" && !element.properties.empty();
  };
  const auto behind = std::find_if(all.rbegin(), all.rend(), is_points).base();
  for (auto at = all.begin(); at != behind; ++at) {
    const Columns xyz = is_points(*at) ? xyz_of(ply, *at) : Columns{};
    if (is_points(*at)) points.reserve(ply.most_items(*at));
    ply.for_each_item(*at, [&](const PlyItem& item) {
      if (is_points(*at)) points.push_back((three_of(item, xyz) + offset_m).cast<float>());
    });
  }
  try {
    for (auto at = behind; at != all.end(); ++at) ply.for_each_item(*at, [](const PlyItem&) {});
    ply.warn_of_rest(warnings);
  } catch (const BadInput& fault) {
    if (ply.is_free()) throw;
    warnings.push_back(fmt::format("{}; behind the vertices: points may be missing", fault.what()));
  }
  return points;
}

}  // namespace gnbv
