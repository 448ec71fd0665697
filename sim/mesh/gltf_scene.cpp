// read_gltf() of sim/mesh/mesh_scene.hpp.
#include <algorithm>
#include <array>
#include <set>

#include "sim/mesh/gltf_looks.hpp"
#include "sim/mesh/mesh_scene.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

using Json = GltfFile::Json;
using Matrix4 = Eigen::Matrix4d;

Matrix4 placed(const double* translation, const double* rotation, const double* scale) {
  Eigen::Quaterniond q(rotation[3], rotation[0], rotation[1], rotation[2]);
  if (q.norm() > 0.0) q.normalize();
  Matrix4 T = Matrix4::Identity();
  T.topLeftCorner<3, 3>() = q.toRotationMatrix() * Vec3(scale[0], scale[1], scale[2]).asDiagonal();
  T.topRightCorner<3, 1>() = Vec3(translation[0], translation[1], translation[2]);
  return T;
}

Vec3 moved(const Matrix4& T, const Vec3& p) {
  return T.topLeftCorner<3, 3>() * p + T.topRightCorner<3, 1>();
}

std::string compressed_by(std::string_view extension) {
  return fmt::format("is compressed ({}), which is not read: export it without", extension);
}

class GltfReader {
 public:
  GltfReader(const std::filesystem::path& path, bool keeps_uvs)
      : file_(path), looks_(file_, keeps_uvs) {}

  MeshScene read() {
    check_extensions();
    out_.materials = looks_.materials();
    place_nodes();
    std::set<std::size_t> shown;
    for (const std::size_t node : nodes_of_scene()) {
      const auto mesh = file_.index(file_.item("nodes", node), "mesh", "meshes");
      if (!mesh) continue;
      shown.insert(*mesh);
      add_mesh(node, *mesh);
    }
    out_.lose(file_.path(), impossible_, "faces of vertices that do not exist");
    out_.lose(file_.path(), without_positions_, "parts without positions");
    if (const std::size_t hidden = file_.count("meshes") - shown.size(); hidden > 0) {
      out_.warnings.push_back(fmt::format("{}: {} of {} meshes are not in the scene, and left out",
                                          file_.path().string(), hidden, file_.count("meshes")));
    }
    looks_.warn(out_.warnings);
    out_.files = file_.files();
    const auto& pictures = looks_.files();
    out_.files.insert(out_.files.end(), pictures.begin(), pictures.end());
    out_.declared = {1.0, 'y', true};
    return std::move(out_);
  }

 private:
  void check_extensions() const {
    const auto required = file_.json().find("extensionsRequired");
    if (required == file_.json().end()) return;
    if (!required->is_array()) file_.fail("'extensionsRequired' is no list");
    // of looks and lights alone
    constexpr std::array<std::string_view, 10> kLooks = {
        "KHR_materials_", "KHR_texture_", "EXT_texture_",   "MSFT_texture_", "KHR_lights_",
        "EXT_lights_",    "KHR_xmp",      "KHR_animation_", "KHR_audio",     "KHR_technique"};
    for (const Json& name : *required) {
      const std::string word = name.is_string() ? name.get<std::string>() : name.dump();
      if (word == "KHR_mesh_quantization" || word == "EXT_mesh_gpu_instancing") continue;
      const bool is_look = std::any_of(kLooks.begin(), kLooks.end(),
                                       [&](std::string_view of) { return word.starts_with(of); });
      if (is_look) continue;
      const bool is_compressed = word.find("compression") != word.npos;
      file_.fail(is_compressed ? compressed_by(word)
                               : fmt::format("requires the extension {}, which is not read",
                                             word.substr(0, 60)));
    }
  }

  Matrix4 T_parent_node(const Json& node) const {
    if (node.contains("matrix")) {
      const auto values = file_.list(node, "matrix", std::vector<double>(16));
      return Eigen::Map<const Matrix4>(values.data());
    }
    const auto translation = file_.list(node, "translation", {0, 0, 0});
    const auto rotation = file_.list(node, "rotation", {0, 0, 0, 1});
    const auto scale = file_.list(node, "scale", {1, 1, 1});
    return placed(translation.data(), rotation.data(), scale.data());
  }

  /// Of every node, in the scene or not: joints may stand anywhere.
  void place_nodes() {
    const std::size_t count = file_.count("nodes");
    T_file_node_.assign(count, Matrix4::Identity());
    children_.resize(count);
    has_parent_.assign(count, false);
    for (std::size_t i = 0; i < count; ++i) {
      children_[i] = file_.indices(file_.item("nodes", i), "children", "nodes");
      for (const std::size_t child : children_[i]) {
        if (has_parent_[child]) file_.fail(fmt::format("nodes[{}] has two parents", child));
        has_parent_[child] = true;
      }
    }
    std::size_t placed_count = 0;
    for (const std::size_t root : roots()) {
      for (const std::size_t node : family_of({root})) {
        ++placed_count;
        T_file_node_[node] *= T_parent_node(file_.item("nodes", node));
        for (const std::size_t child : children_[node]) T_file_node_[child] = T_file_node_[node];
      }
    }
    if (placed_count < count) file_.fail("a node is its own ancestor");
  }

  std::vector<std::size_t> roots() const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < has_parent_.size(); ++i) {
      if (!has_parent_[i]) out.push_back(i);
    }
    return out;
  }

  /// These nodes and all below them, each once, parents first.
  std::vector<std::size_t> family_of(std::vector<std::size_t> open) const {
    std::vector<std::size_t> out;
    std::set<std::size_t> seen;
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      if (!seen.insert(node).second) continue;
      out.push_back(node);
      open.insert(open.end(), children_[node].rbegin(), children_[node].rend());
    }
    return out;
  }

  std::vector<std::size_t> nodes_of_scene() const {
    if (file_.count("scenes") == 0) return family_of(roots());
    const std::size_t scene = file_.index(file_.json(), "scene", "scenes").value_or(0);
    return family_of(file_.indices(file_.item("scenes", scene), "nodes", "nodes"));
  }

  void add_mesh(std::size_t node_index, std::size_t mesh_index) {
    const Json& node = file_.item("nodes", node_index);
    const Json& mesh = file_.item("meshes", mesh_index);
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) {
      file_.fail(fmt::format("meshes[{}] has no list of primitives", mesh_index));
    }
    const auto skin = file_.index(node, "skin", "skins");
    const std::vector<double> weights =
        file_.list(node, "weights", file_.list(mesh, "weights", {}));
    const std::vector<Matrix4> places = places_of(node_index);
    for (std::size_t i = 0; i < primitives->size(); ++i) {
      const Json& primitive = (*primitives)[i];
      if (!primitive.is_object()) file_.fail("a primitive is no object");
      const bool is_shared = !skin && weights.empty();
      const auto [entry, is_new] = part_of_.try_emplace(
          {mesh_index, is_shared ? -1 : static_cast<long long>(node_index), i}, out_.parts.size());
      const std::size_t material = looks_.material_of(primitive);
      if (is_new) add_part(primitive, weights, skin, material);
      // only joints place a skinned mesh
      for (const Matrix4& T : places) {
        out_.instances.push_back({entry->second, material, skin ? Matrix4::Identity() : T});
      }
    }
  }

  std::vector<Matrix4> places_of(std::size_t node) {
    const Json& from =
        object_in(object_in(file_.item("nodes", node), "extensions"), "EXT_mesh_gpu_instancing");
    const Json& attributes = object_in(from, "attributes");
    std::vector<Matrix4> out;
    const auto column = [&](const char* name, std::size_t width) -> GltfNumbers {
      const auto accessor = file_.index(attributes, name, "accessors");
      return accessor ? file_.numbers(*accessor, width) : GltfNumbers{width, {}};
    };
    const GltfNumbers translation = column("TRANSLATION", 3);
    const GltfNumbers rotation = column("ROTATION", 4);
    const GltfNumbers scale = column("SCALE", 3);
    const std::size_t count = std::max({translation.rows(), rotation.rows(), scale.rows()});
    if (count == 0) return {T_file_node_[node]};
    constexpr std::array kNone = {0.0, 0.0, 0.0, 1.0}, kAll = {1.0, 1.0, 1.0, 1.0};
    const auto row = [](const GltfNumbers& of, std::size_t i, const double* fallback) {
      return i < of.rows() ? of.row(i) : fallback;
    };
    for (std::size_t i = 0; i < count; ++i) {
      out.push_back(T_file_node_[node] * placed(row(translation, i, kNone.data()),
                                                row(rotation, i, kNone.data()),
                                                row(scale, i, kAll.data())));
    }
    return out;
  }

  void add_part(const Json& primitive, const std::vector<double>& weights,
                std::optional<std::size_t> skin, std::size_t material) {
    MeshScene::Part& part = out_.parts.emplace_back();
    constexpr std::size_t kTriangles = 4, kFan = 6;  // 5 is a strip
    const std::size_t mode = file_.size(primitive, "mode", kTriangles);
    if (mode < kTriangles) return;  // points and lines
    if (mode > kFan) file_.fail(fmt::format("a primitive has the mode {}", mode));
    const Json& attributes = object_in(primitive, "attributes");
    const auto position = file_.index(attributes, "POSITION", "accessors");
    const bool is_compressed =
        object_in(primitive, "extensions").contains("KHR_draco_mesh_compression");
    if (is_compressed &&
        (!position || !file_.item("accessors", *position).contains("bufferView"))) {
      file_.fail(compressed_by("KHR_draco_mesh_compression"));
    }
    if (!position) {
      ++without_positions_;
      return;
    }
    part.vertices = positions_of(*position);
    morph(primitive, weights, part.vertices);
    if (skin) pose(attributes, *skin, part.vertices);
    add_faces(primitive, mode == kTriangles, mode == kFan, part);
    const auto looks = looks_.of_vertices(attributes, material, part.vertices.size());
    if (looks.empty()) return;
    for (const auto& [a, b, c] : part.faces)
      part.looks[0].push_back({looks[a], looks[b], looks[c]});
  }

  std::vector<Vec3> positions_of(std::size_t accessor) {
    const GltfNumbers numbers = file_.numbers(accessor, 3);
    std::vector<Vec3> out;
    out.reserve(numbers.rows());
    for (std::size_t i = 0; i < numbers.rows(); ++i) {
      out.push_back(Eigen::Map<const Vec3>(numbers.row(i)));
    }
    return out;
  }

  void morph(const Json& primitive, const std::vector<double>& weights,
             std::vector<Vec3>& vertices) {
    const auto targets = primitive.find("targets");
    if (targets == primitive.end() || !targets->is_array()) return;
    for (std::size_t k = 0; k < std::min(targets->size(), weights.size()); ++k) {
      if (weights[k] == 0.0 || !(*targets)[k].is_object()) continue;
      const auto accessor = file_.index((*targets)[k], "POSITION", "accessors");
      if (!accessor) continue;
      const std::vector<Vec3> moves = positions_of(*accessor);
      if (moves.size() != vertices.size()) file_.fail("a morph target has another length");
      for (std::size_t i = 0; i < moves.size(); ++i) vertices[i] += weights[k] * moves[i];
    }
  }

  /// Of vertices or joints: never below 0.
  GltfNumbers names_in(std::size_t accessor, std::size_t width) {
    constexpr std::array<std::size_t, 3> kUnsigned = {5121, 5123, 5125};
    const std::size_t type = file_.size(file_.item("accessors", accessor), "componentType", 0);
    if (std::ranges::count(kUnsigned, type) == 0) {
      file_.fail(fmt::format(
          "accessors[{}] names vertices or joints, by the componentType {}: no unsigned integers",
          accessor, type));
    }
    return file_.numbers(accessor, width);
  }

  /// Each vertex to where its joints carry it.
  void pose(const Json& attributes, std::size_t skin_index, std::vector<Vec3>& vertices) {
    const Json& skin = file_.item("skins", skin_index);
    const std::vector<std::size_t> joints = file_.indices(skin, "joints", "nodes");
    std::vector<Matrix4> T_file_bind(joints.size());
    const auto inverse = file_.index(skin, "inverseBindMatrices", "accessors");
    const GltfNumbers matrices = inverse ? file_.numbers(*inverse, 16) : GltfNumbers{16, {}};
    if (inverse && matrices.rows() < joints.size()) file_.fail("a skin lacks bind matrices");
    for (std::size_t i = 0; i < joints.size(); ++i) {
      T_file_bind[i] = T_file_node_[joints[i]];
      if (inverse) T_file_bind[i] *= Eigen::Map<const Matrix4>(matrices.row(i));
    }
    std::vector<Vec3> posed(vertices.size(), Vec3::Zero());
    std::vector<double> sums(vertices.size(), 0.0);
    for (std::size_t set = 0;; ++set) {
      const auto of_joints =
          file_.index(attributes, fmt::format("JOINTS_{}", set).c_str(), "accessors");
      const auto of_weights =
          file_.index(attributes, fmt::format("WEIGHTS_{}", set).c_str(), "accessors");
      if (!of_joints || !of_weights) break;
      const GltfNumbers names = names_in(*of_joints, 4);
      const GltfNumbers shares = file_.numbers(*of_weights, 4);
      if (std::min(names.rows(), shares.rows()) < vertices.size()) {
        file_.fail("a skin has fewer weights than vertices");
      }
      for (std::size_t i = 0; i < 4 * vertices.size(); ++i) {
        if (shares.values[i] == 0.0) continue;
        if (!(names.values[i] < static_cast<double>(joints.size()))) {
          file_.fail(fmt::format("a vertex names joint {} of {}", names.values[i], joints.size()));
        }
        const Matrix4& T = T_file_bind[static_cast<std::size_t>(names.values[i])];
        posed[i / 4] += shares.values[i] * moved(T, vertices[i / 4]);
        sums[i / 4] += shares.values[i];
      }
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (sums[i] != 0.0) vertices[i] = posed[i] / sums[i];
    }
  }

  void add_faces(const Json& primitive, bool are_triangles, bool is_fan, MeshScene::Part& part) {
    const auto accessor = file_.index(primitive, "indices", "accessors");
    const GltfNumbers named = accessor ? names_in(*accessor, 1) : GltfNumbers{};
    const std::size_t count = accessor ? named.rows() : part.vertices.size();
    const auto corner = [&](std::size_t i) -> std::uint32_t {
      const double value = accessor ? named.values[i] : static_cast<double>(i);
      return value < static_cast<double>(part.vertices.size()) ? static_cast<std::uint32_t>(value)
                                                               : kNoVertex;
    };
    const std::size_t step = are_triangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < count; i += step) {
      std::array<std::uint32_t, 3> face = {corner(is_fan ? 0 : i), corner(i + 1), corner(i + 2)};
      if (!are_triangles && !is_fan && i % 2 == 1) std::swap(face[0], face[1]);
      if (std::find(face.begin(), face.end(), kNoVertex) != face.end()) {
        ++impossible_;
      } else {
        part.faces.push_back(face);
      }
    }
    if (are_triangles && count % 3 != 0) ++impossible_;
  }

  GltfFile file_;
  GltfLooks looks_;
  MeshScene out_;
  std::vector<Matrix4> T_file_node_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<bool> has_parent_;
  // by mesh, node that shapes it (-1: none does) and primitive
  std::map<std::tuple<std::size_t, long long, std::size_t>, std::size_t> part_of_;
  std::size_t impossible_ = 0, without_positions_ = 0;
};

}  // namespace

MeshScene read_gltf(const std::filesystem::path& path, bool keeps_uvs) {
  return GltfReader(path, keeps_uvs).read();
}

}  // namespace gnbv
