// The pictures that a mesh file names: PNG and JPEG, read where programs leave them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// A PNG or JPEG by its bytes, as RGB8 in sRGB; opaque, whatever its alpha. Throws BadInput saying
/// what is wrong with it, or that it has more than `most_px` pixels.
Image read_picture(std::string_view bytes, std::size_t most_px);

/// The file that a path or URI in a mesh file stands for: beside it (percent-encoded, file:, with
/// backslashes or not); else its last name there, in `textures` or, as of Gazebo's models, in
/// `../materials/textures`. Empty where there is none.
std::filesystem::path file_of_uri(const std::filesystem::path& mesh, const std::string& uri);

/// Reads each picture of a mesh file once. One that is missing, damaged or too large is none, and
/// is named in the warnings: nothing of it may refuse a shape.
class TextureFiles {
 public:
  /// Of one mesh: 0.8 GB of them.
  static constexpr std::size_t kMostPixels = std::size_t{1} << 28U;

  explicit TextureFiles(std::filesystem::path mesh) : mesh_(std::move(mesh)) {}

  Texture at(const std::string& uri, const std::array<Wrap, 2>& wrap);
  /// A picture whose bytes the file holds.
  Texture of(const std::string& name, std::string_view bytes, const std::array<Wrap, 2>& wrap);
  /// A picture that the file describes wrongly.
  void miss(const std::string& name, const std::string& why);

  /// Appends a sentence for each kind of fault.
  void warn(std::vector<std::string>& warnings) const;
  /// The files that were read.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::filesystem::path mesh_;
  std::map<std::string, std::shared_ptr<const Image>> images_;  // by name; null: not usable
  std::map<std::string, std::vector<std::string>> missed_;      // names by what is wrong
  std::vector<std::filesystem::path> files_;
  std::size_t pixels_ = 0;
};

/// The bytes of a "data:" URI (RFC 2397); nothing for what is no base64 and says that it is.
std::optional<std::string> bytes_of_data_uri(std::string_view uri);

}  // namespace gnbv
