// The material libraries (.mtl) of an OBJ file, and which of them its faces use.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/texture_file.hpp"

namespace gnbv {

/// Faces ahead of the first `usemtl` have the last material of a library named before them, or
/// otherwise that of the first `usemtl`.
class ObjMaterials {
 public:
  explicit ObjMaterials(std::string path);

  /// Takes the names, the diffuse colours (Kd) and their pictures (map_Kd, which lie in `folder`)
  /// of a library, which may come after their use.
  void read_library(std::istream& file, const std::filesystem::path& library,
                    const std::filesystem::path& folder);
  void use(const std::string& name);

  /// Of the current material among those that faces use, in order of first use. Throws BadInput
  /// naming the file when they become too many.
  std::uint16_t index_for_face();

  /// Whether texture coordinates are wanted, as far as can be said now.
  bool may_have_pictures() const { return has_pictures_ || !has_library_; }

  bool has_library() const { return has_library_; }

  /// Those that faces use, once all is read. A picture is multiplied by Kd, but where that is
  /// black or not given.
  std::vector<Material> materials(TextureFiles& textures, std::vector<std::string>& warnings);
  /// A texture coordinate of OBJ, whose v goes up, as that of a face of the material, by its
  /// options -s and -o.
  Vec2f placed(std::size_t material, const Vec2f& uv) const;

 private:
  struct Entry {
    std::optional<std::array<float, 3>> rgb = {};
    std::string map = {};
    Vec2f scale = {1.0F, 1.0F}, offset = {0.0F, 0.0F};
    bool is_clamped = false;
    std::string unread_option = {};
  };

  /// The values of a map_Kd: options, then a name that may have blanks.
  static void read_map(Words values, const std::filesystem::path& folder, Entry& to);

  std::string path_;
  std::map<std::string, Entry> entries_;           // of the libraries' materials
  std::map<std::string, std::uint16_t> index_of_;  // of the materials that faces use
  std::vector<Entry> used_;                        // by that index, once all is read
  std::string current_;
  std::optional<std::uint16_t> index_;  // of the current one, once a face has used it
  bool is_named_ = false;               // by a usemtl
  bool has_library_ = false, has_pictures_ = false;
};

}  // namespace gnbv
