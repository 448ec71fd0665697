// The container of a glTF 2 file: its JSON, and the numbers that accessors find in its buffers.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

/// Rows of `width` numbers, one after the other.
struct GltfNumbers {
  std::size_t width = 1;
  std::vector<double> values;

  std::size_t rows() const { return values.size() / width; }
  const double* row(std::size_t i) const { return values.data() + i * width; }
};

/// All of it throws BadInput naming the file and the place in its JSON that is wrong.
class GltfFile {
 public:
  using Json = nlohmann::json;

  /// Reads .gltf or .glb, by content; buffers are read when accessors ask for them.
  explicit GltfFile(const std::filesystem::path& path);

  const Json& json() const { return json_; }
  const std::filesystem::path& path() const { return path_; }

  /// Number of items of an array at the root.
  std::size_t count(const char* array) const;
  /// One of them, an object.
  const Json& item(const char* array, std::size_t i) const;
  /// The index into `array` under a key; nothing without the key.
  std::optional<std::size_t> index(const Json& object, const char* key, const char* array) const;
  /// The indices into `array` in the list under a key.
  std::vector<std::size_t> indices(const Json& object, const char* key, const char* array) const;
  /// A count under a key, or the fallback.
  std::size_t size(const Json& object, const char* key, std::size_t fallback) const;
  /// The numbers of the list under a key, or the fallback.
  std::vector<double> list(const Json& object, const char* key, std::vector<double> fallback) const;
  /// What an accessor gives, `width` numbers a row; integers that stand for shares as such.
  GltfNumbers numbers(std::size_t accessor, std::size_t width);

  /// The bytes of a bufferView.
  std::string_view view(std::size_t i);
  /// The files of the buffers that were read.
  const std::vector<std::filesystem::path>& files() const { return files_; }

  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view buffer(std::size_t i);
  void read_rows(std::string_view bytes, std::size_t stride, int component, bool is_share,
                 std::size_t first, std::size_t rows, GltfNumbers& out) const;
  void read_sparse(const Json& sparse, int component, bool is_share, GltfNumbers& out);

  std::filesystem::path path_;
  Json json_;
  std::optional<std::string> chunk_;  // the bytes within a .glb
  std::map<std::size_t, std::string> buffers_;
  std::vector<std::filesystem::path> files_;
};

/// An object under a key; an empty one without it.
const GltfFile::Json& object_in(const GltfFile::Json& object, const char* key);
/// A text under a key; an empty one without it.
std::string text_in(const GltfFile::Json& object, const char* key);

}  // namespace gnbv
