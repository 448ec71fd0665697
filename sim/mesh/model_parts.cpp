#include "sim/mesh/model_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Matrix4 = Eigen::Matrix4d;

constexpr std::size_t kMostModelFaces = std::size_t{1} << 27U;

/// How many sides keep the flat ones within 2 mm of the round surface.
int sides_for(double radius_m) {
  constexpr double kOff_m = 2e-3;
  const double sides = kPi / std::acos(std::clamp(1.0 - kOff_m / radius_m, 0.0, 1.0 - 1e-9));
  return 4 * static_cast<int>(std::ceil(std::clamp(sides, 16.0, 256.0) / 4.0));
}

/// The surface of a profile of (radius, height) from bottom to top, turned about z.
TriangleMesh revolved(const std::vector<Eigen::Vector2d>& profile, int sides) {
  TriangleMesh mesh;
  const auto turn = [&](int i) { return 2.0 * kPi * (i % sides) / sides; };
  std::vector<std::uint32_t> first;
  for (const Eigen::Vector2d& p : profile) {
    first.push_back(static_cast<std::uint32_t>(mesh.vertices_m.size()));
    for (int i = 0; i < (p.x() > 0.0 ? sides : 1); ++i) {
      mesh.vertices_m.emplace_back(p.x() * std::cos(turn(i)), p.x() * std::sin(turn(i)), p.y());
    }
  }
  const auto at = [&](std::size_t k, int i) {
    return first[k] + static_cast<std::uint32_t>(profile[k].x() > 0.0 ? i % sides : 0);
  };
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    for (int i = 0; i < sides; ++i) {
      if (profile[k].x() > 0.0) mesh.faces.push_back({at(k, i), at(k, i + 1), at(k + 1, i + 1)});
      if (profile[k + 1].x() > 0.0)
        mesh.faces.push_back({at(k, i), at(k + 1, i + 1), at(k + 1, i)});
    }
  }
  return mesh;
}

/// A ball, pulled apart along z by a length.
TriangleMesh capsule(double radius_m, double length_m) {
  const int sides = sides_for(radius_m), quarter = sides / 4;
  std::vector<Eigen::Vector2d> profile;
  for (int i = -quarter; i <= quarter; ++i) {
    const double angle_rad = kPi / 2.0 * i / quarter;
    const bool is_pole = std::abs(i) == quarter;
    profile.emplace_back(is_pole ? 0.0 : radius_m * std::cos(angle_rad),
                         radius_m * std::sin(angle_rad) + (i < 0 ? -0.5 : 0.5) * length_m);
    if (i == 0 && length_m > 0.0) profile.insert(profile.end() - 1, {radius_m, -0.5 * length_m});
  }
  return revolved(profile, sides);
}

void transform(TriangleMesh& mesh, const Matrix4& T) {
  for (Vec3f& p : mesh.vertices_m) {
    p = (T.topLeftCorner<3, 3>() * p.cast<double>() + T.topRightCorner<3, 1>()).cast<float>();
  }
  if (T.topLeftCorner<3, 3>().determinant() >= 0.0) return;
  for (auto& face : mesh.faces) std::swap(face[1], face[2]);
  for (auto& looks : mesh.face_looks) std::swap(looks[1], looks[2]);
}

/// 1.10 comes after 1.9; without a version, after all.
std::array<double, 2> version_of(const XmlElement& sdf) {
  constexpr double kLast = std::numeric_limits<double>::infinity();
  const std::string text = trimmed(sdf.attribute("version").value_or(""));
  const std::size_t point = std::min(text.find('.'), text.size());
  return {read_decimal(text.substr(0, point)).value_or(kLast),
          read_decimal(text.substr(std::min(point + 1, text.size()))).value_or(0.0)};
}

/// An attribute of URDF or a child of SDF.
std::string value_of(const fs::path& document, const XmlElement& shape, const char* name) {
  const auto attribute = shape.attribute(name);
  if (!attribute && !shape.child(name)) {
    fail_at(document, shape, fmt::format("<{}> without {}", shape.name(), name));
  }
  return trimmed(attribute ? *attribute : shape.child(name).text());
}

}  // namespace

void fail_at(const fs::path& document, const XmlElement& at, const std::string& what) {
  throw BadInput("{}:{}: {}", document.string(), at.line(), what);
}

std::vector<double> numbers_of(const fs::path& document, const XmlElement& at,
                               const std::string& text, std::initializer_list<std::size_t> counts) {
  std::string_view rest = text;
  std::vector<double> values;
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
    const auto value = read_decimal(word);
    if (!value || !std::isfinite(*value)) {
      fail_at(document, at, fmt::format("<{}>: '{}' is no number", at.name(), word.substr(0, 60)));
    }
    values.push_back(*value);
  }
  if (std::find(counts.begin(), counts.end(), values.size()) == counts.end()) {
    fail_at(document, at, fmt::format("<{}> has {} numbers", at.name(), values.size()));
  }
  return values;
}

std::array<float, 3> rgb_of(const fs::path& document, const XmlElement& at,
                            const std::string& text) {
  const auto v = numbers_of(document, at, text, {3, 4});
  std::array<float, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) rgb[i] = static_cast<float>(std::clamp(v[i], 0.0, 1.0));
  return rgb;
}

Matrix4 placed(const Vec3& p_m, const Eigen::Matrix3d& R) {
  Matrix4 T = Matrix4::Identity();
  T.topLeftCorner<3, 3>() = R;
  T.topRightCorner<3, 1>() = p_m;
  return T;
}

Eigen::Matrix3d R_rpy(double roll_rad, double pitch_rad, double yaw_rad) {
  return (Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()) *
          Eigen::AngleAxisd(roll_rad, Vec3::UnitX()))
      .toRotationMatrix();
}

fs::path resolved(const fs::path& document, const XmlElement& at, std::string uri) {
  uri = percent_decoded(trimmed(uri));
  if (uri.empty()) fail_at(document, at, fmt::format("<{}> names no file", at.name()));
  const fs::path folder = fs::absolute(document).parent_path();
  const std::size_t scheme = uri.find("://");
  const std::string kind = scheme == uri.npos ? "" : uri.substr(0, scheme);
  const std::string rest = scheme == uri.npos ? uri : uri.substr(scheme + 3);
  std::error_code ignored;
  if (kind.empty() || kind == "file") {
    if (!rest.empty() && fs::exists(folder / rest, ignored)) return folder / rest;
  } else if (kind == "model" || kind == "package") {
    // with the name of the model or package, or in a folder that was renamed
    const std::size_t slash = std::min(rest.find('/'), rest.size() - 1);
    for (const std::string& name : {rest, rest.substr(slash + 1)}) {
      constexpr int kMostUp = 8;
      fs::path from = folder;
      for (int up = 0; !name.empty() && up < kMostUp; ++up, from = from.parent_path()) {
        if (fs::exists(from / name, ignored)) return from / name;
      }
    }
  } else {
    fail_at(document, at, fmt::format("'{}' is on no disk: download it beside the file", uri));
  }
  fail_at(document, at, fmt::format("'{}' is neither in {} nor above it", uri, folder.string()));
}

const ModelParts::FileMesh& ModelParts::mesh_at(const fs::path& file, bool keeps_uvs) {
  if (is_model(file)) throw BadInput("{}: is no mesh of a visual", file.string());
  const auto [entry, is_new] = meshes_.try_emplace({file.lexically_normal().string(), keeps_uvs});
  if (!is_new) return entry->second;
  const bool is_collada = extension_of(file) == ".dae";
  MeshFileConfig config{.path = entry->first.first, .up_axis = is_collada ? "z" : "auto"};
  MeshReading part = read_mesh(config, keeps_uvs);
  if (const auto offset_m = offset_to_origin_m(part.mesh)) {
    config.offset_m = *offset_m;
    part = read_mesh(config, keeps_uvs);
  }
  if (!part.not_finite.empty() && reading.not_finite.empty()) reading.not_finite = part.not_finite;
  reading.lost_faces += part.lost_faces;
  reading.warnings.insert(reading.warnings.end(), part.warnings.begin(), part.warnings.end());
  reading.files.push_back(file);
  reading.files.insert(reading.files.end(), part.files.begin(), part.files.end());
  return entry->second = {std::move(part.mesh), config.offset_m};
}

TriangleMesh ModelParts::shape_of(const fs::path& document, const XmlElement& shape, bool keeps_uvs,
                                  Matrix4& T_model_geometry) {
  const std::string_view kind = shape.name();
  const auto sizes = [&](const char* name, std::size_t count) {
    const auto v = numbers_of(document, shape, value_of(document, shape, name), {count});
    if (*std::min_element(v.begin(), v.end()) <= 0.0) {
      fail_at(document, shape, fmt::format("<{}> has a {} that is not positive", kind, name));
    }
    return v;
  };
  if (kind == "box") {
    const auto v = sizes("size", 3);
    const Vec3 half_m = 0.5 * Vec3(v[0], v[1], v[2]);
    return box_mesh(Box3(-half_m, half_m));
  }
  if (kind == "sphere") return capsule(sizes("radius", 1)[0], 0.0);
  if (kind == "capsule") return capsule(sizes("radius", 1)[0], sizes("length", 1)[0]);
  if (kind == "ellipsoid") {
    const auto v = sizes("radii", 3);
    const double longest_m = *std::max_element(v.begin(), v.end());
    TriangleMesh mesh = capsule(longest_m, 0.0);
    transform(mesh, placed(Vec3::Zero(),
                           Vec3(v[0], v[1], v[2]).asDiagonal().toDenseMatrix() / longest_m));
    return mesh;
  }
  if (kind == "cylinder" || kind == "cone") {
    const double radius_m = sizes("radius", 1)[0], half_m = 0.5 * sizes("length", 1)[0];
    std::vector<Eigen::Vector2d> profile = {{0, -half_m}, {radius_m, -half_m}, {0, half_m}};
    if (kind == "cylinder") profile.insert(profile.end() - 1, {radius_m, half_m});
    return revolved(profile, sides_for(radius_m));
  }
  if (kind != "mesh") fail_at(document, shape, fmt::format("<{}> is not read", kind));
  if (shape.child("submesh")) fail_at(document, shape, "<submesh> is not read");
  const bool is_urdf = shape.attribute("filename").has_value();
  auto [mesh, offset_m] =
      mesh_at(resolved(document, shape, value_of(document, shape, is_urdf ? "filename" : "uri")),
              keeps_uvs);
  Matrix4 scaling = Matrix4::Identity();
  if (shape.attribute("scale") || shape.child("scale")) {
    auto v = numbers_of(document, shape, value_of(document, shape, "scale"), {1, 3});
    v.resize(3, v[0]);
    scaling.diagonal().head<3>() = Vec3(v[0], v[1], v[2]);
    if (offset_m.isZero()) transform(mesh, scaling);
  }
  if (!offset_m.isZero()) {
    T_model_geometry *= scaling * placed(-offset_m, Eigen::Matrix3d::Identity());
  }
  return std::move(mesh);
}

void ModelParts::add(const fs::path& document, const XmlElement& visual, Matrix4 T_model_geometry,
                     const Look& look) {
  const std::vector<XmlElement> shapes = visual.child("geometry").children();
  if (shapes.size() != 1) {
    fail_at(document, visual, fmt::format("its <geometry> is of {} shapes", shapes.size()));
  }
  if (shapes[0].name() == "empty") return;
  if (shapes[0].name() == "plane" || shapes[0].name() == "heightmap") {
    ++planes_;
    return;
  }
  TriangleMesh part =
      shape_of(document, shapes[0], look.texture.image != nullptr, T_model_geometry);
  transform(part, T_world_model_ * T_model_geometry);
  const Material& first = part.materials.front();
  if (part.materials.size() == 1 &&
      (first.name == Material{}.name || first.name == kDefaultMaterial)) {
    part.materials[0] = {.name = "model", .rgb = look.rgb.value_or(kDefaultColour)};
  }
  if (look.texture.image && part.face_looks.empty()) {
    pictures_.miss(look.texture.name, "of shapes without texture coordinates");
  } else if (look.texture.image) {
    for (Material& material : part.materials) {
      if (material.texture.image) continue;
      material.rgb = {1.0F, 1.0F, 1.0F};
      material.texture = look.texture;
    }
  }
  if (reading.mesh.faces.size() + part.faces.size() > kMostModelFaces) {
    fail_at(document, visual, fmt::format("more than {} faces", kMostModelFaces));
  }
  part.face_material.resize(part.faces.size());
  if (reading.mesh.faces.empty()) {
    reading.mesh = std::move(part);
  } else {
    append(reading.mesh, part);
  }
}

Texture ModelParts::picture(const fs::path& document, const XmlElement& at,
                            const std::string& uri) {
  try {
    return pictures_.at(resolved(document, at, uri).string(), {});
  } catch (const BadInput&) {
    return pictures_.at(trimmed(uri), {});  // beside it under its last name, or not there
  }
}

void ModelParts::finish(const fs::path& document) {
  pictures_.warn(reading.warnings);
  reading.files.insert(reading.files.end(), pictures_.files().begin(), pictures_.files().end());
  if (planes_ == 0) return;
  reading.warnings.push_back(fmt::format(
      "{}: {} planes or heightmaps left out: the ground is ours, `terrain.path` takes a mesh of it",
      document.string(), planes_));
}

bool is_model(const fs::path& path) {
  const std::string extension = extension_of(path);
  std::error_code ignored;
  return extension == ".sdf" || extension == ".world" || extension == ".urdf" ||
         fs::is_directory(path, ignored);
}

fs::path model_file_of(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return path;
  if (fs::exists(path / "model.config", ignored)) {
    std::vector<std::string> warnings;
    const XmlTree config(path / "model.config", warnings);
    const auto versions = config.root().children("sdf");
    const auto newest = std::max_element(
        versions.rbegin(), versions.rend(),
        [](const XmlElement& a, const XmlElement& b) { return version_of(a) < version_of(b); });
    if (newest != versions.rend()) return path / trimmed(newest->text());
  }
  if (fs::exists(path / "model.sdf", ignored)) return path / "model.sdf";
  throw BadInput("{}: is a directory without model.sdf or model.config", path.string());
}

MeshReading read_model(const fs::path& path, const Matrix4& T_world_model) {
  ModelParts parts(path, T_world_model);
  (extension_of(path) == ".urdf" ? read_urdf : read_sdf)(path, parts);
  parts.finish(path);
  return std::move(parts.reading);
}

}  // namespace gnbv
