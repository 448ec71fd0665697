// What URDF and SDF models share: visible geometry of links, placed in one mesh.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/texture_file.hpp"
#include "sim/mesh/xml_tree.hpp"

namespace gnbv {

/// The mesh of the visuals of a URDF model (links at joint positions 0) or an SDF model or world,
/// by extension; of .world, SDF. Meshes lie beside the file: `model://` and `package://` are looked
/// for from its folder upwards. Collision shapes are passed over; so are planes and heightmaps,
/// with a warning. The up axis of COLLADA is passed over as Gazebo and RViz do, its unit is not.
/// Throws BadInput naming file and line of what is not read.
MeshReading read_model(const std::filesystem::path& path, const Eigen::Matrix4d& T_world_model);

/// Whether read_model() reads it: by what lies beside it, too.
bool is_model(const std::filesystem::path& path);

/// The model file of a folder: what its model.config names, or model.sdf; the path itself where it
/// is no folder. Throws BadInput for a folder without one.
std::filesystem::path model_file_of(const std::filesystem::path& path);

class ModelParts {
 public:
  using Matrix4 = Eigen::Matrix4d;
  /// What the material of a visual says.
  struct Look {
    std::optional<std::array<float, 3>> rgb = {};
    Texture texture = {};
  };

  ModelParts(const std::filesystem::path& path, const Matrix4& T_world_model)
      : T_world_model_(T_world_model), pictures_(path) {}

  /// Adds the <geometry> of a <visual>: box, sphere, cylinder, capsule, cone, ellipsoid or
  /// mesh, of URDF or SDF. The look is of what has none of its own.
  void add(const std::filesystem::path& document, const XmlElement& visual,
           Matrix4 T_model_geometry, const Look& look);
  /// The picture that a material names; one that is not there is none, with a warning.
  Texture picture(const std::filesystem::path& document, const XmlElement& at,
                  const std::string& uri);
  /// Appends what has to be said of planes and pictures. All is added.
  void finish(const std::filesystem::path& document);

  MeshReading reading;

 private:
  /// A mesh file's, less what would round off its millimetres: the offset of a map grid.
  struct FileMesh {
    TriangleMesh mesh = {};
    Vec3 offset_m = Vec3::Zero();  // added to what the file says
  };

  /// In the frame that `T_model_geometry` becomes the pose of.
  TriangleMesh shape_of(const std::filesystem::path& document, const XmlElement& shape,
                        bool keeps_uvs, Matrix4& T_model_geometry);
  const FileMesh& mesh_at(const std::filesystem::path& file, bool keeps_uvs);

  Matrix4 T_world_model_;
  std::map<std::pair<std::string, bool>, FileMesh> meshes_;  // by path and keeps_uvs
  TextureFiles pictures_;                                    // of materials, not of meshes
  std::size_t planes_ = 0;
};

[[noreturn]] void fail_at(const std::filesystem::path& document, const XmlElement& at,
                          const std::string& what);

/// The numbers of a text, as many as `counts` allows. Throws BadInput naming the element.
std::vector<double> numbers_of(const std::filesystem::path& document, const XmlElement& at,
                               const std::string& text, std::initializer_list<std::size_t> counts);

/// Three of a text's three or four numbers, each in [0, 1]. Throws as numbers_of().
std::array<float, 3> rgb_of(const std::filesystem::path& document, const XmlElement& at,
                            const std::string& text);

/// Roll, pitch and yaw about fixed axes, rad.
Eigen::Matrix4d placed(const Vec3& p_m, const Eigen::Matrix3d& R);
Eigen::Matrix3d R_rpy(double roll_rad, double pitch_rad, double yaw_rad);

/// What a URI of a document stands for. Throws BadInput for one that is not there.
std::filesystem::path resolved(const std::filesystem::path& document, const XmlElement& at,
                               std::string uri);

void read_urdf(const std::filesystem::path& path, ModelParts& to);
void read_sdf(const std::filesystem::path& path, ModelParts& to);

}  // namespace gnbv
