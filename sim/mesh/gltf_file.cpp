#include "sim/mesh/gltf_file.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/texture_file.hpp"

namespace gnbv {
namespace {

struct GltfComponent {
  int type;
  std::size_t bytes;
  double full;  // the integer that stands for 1
  double (*at)(const char* bytes);
};

template <typename T>
double number_of(const char* bytes) {
  return static_cast<double>(number_at<T>(bytes));
}

constexpr std::array kComponents = {
    GltfComponent{5120, 1, 127.0, number_of<std::int8_t>},
    GltfComponent{5121, 1, 255.0, number_of<std::uint8_t>},
    GltfComponent{5122, 2, 32767.0, number_of<std::int16_t>},
    GltfComponent{5123, 2, 65535.0, number_of<std::uint16_t>},
    GltfComponent{5125, 4, 4294967295.0, number_of<std::uint32_t>},
    GltfComponent{5126, 4, 1.0, number_of<float>},
};

const GltfComponent* component_of(int type) {
  for (const GltfComponent& c : kComponents) {
    if (c.type == type) return &c;
  }
  return nullptr;
}

std::string is_other_version(const std::string& major) {
  return fmt::format("is glTF {}, and only glTF 2 is read: export it as glTF 2",
                     major.substr(0, 60));
}

/// The JSON text of a .glb and its bytes; chunks begin where the ones before them end.
std::string json_of_glb(const GltfFile& file, const std::string& glb,
                        std::optional<std::string>& chunk) {
  constexpr std::uint32_t kJson = 0x4E4F534A;
  constexpr std::uint32_t kBytes = 0x004E4942;
  std::optional<std::string> json;
  for (std::size_t at = 12; at + 8 <= glb.size();) {
    const std::size_t size = number_at<std::uint32_t>(glb.data() + at);
    const auto kind = number_at<std::uint32_t>(glb.data() + at + 4);
    at += 8;
    if (size > glb.size() - at) {
      file.fail(
          fmt::format("is cut off: a chunk of {} bytes, and {} are left", size, glb.size() - at));
    }
    if (kind == kJson && !json) json = glb.substr(at, size);
    if (kind == kBytes && !chunk) chunk = glb.substr(at, size);
    at += size;
  }
  if (!json) file.fail("has no chunk of JSON");
  return *json;
}

}  // namespace

void GltfFile::fail(const std::string& what) const {
  throw BadInput("{}: {}", path_.string(), printable(what));
}

GltfFile::GltfFile(const std::filesystem::path& path) : path_(path) {
  std::string text = read_file(path);
  if (text.starts_with("glTF") && text.size() >= 12) {
    if (const auto version = number_at<std::uint32_t>(text.data() + 4); version != 2) {
      fail(is_other_version(std::to_string(version)));
    }
    text = json_of_glb(*this, text, chunk_);
    while (!text.empty() && text.back() == '\0') text.pop_back();  // padding of some writers
  }
  text = as_utf8(std::move(text));
  // whoever copies or prints a value calls itself for each level of it
  const auto is_shallow = [this](int depth, Json::parse_event_t, const Json&) {
    constexpr int kMostDeep = 200;
    if (depth > kMostDeep) fail(fmt::format("its JSON is more than {} deep", kMostDeep));
    return true;
  };
  try {
    json_ = Json::parse(text, is_shallow);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    fail(fmt::format("is no glTF file: line {} is no JSON",
                     1 + std::count(text.begin(), end, '\n')));
  } catch (const Json::exception& error) {  // "[name] number overflow parsing '1e400'"
    const std::string what = error.what();
    fail(fmt::format("is no glTF file: {}", what.substr(what.find("] ") + 2, 100)));
  }
  if (!json_.is_object()) fail("is no glTF file: its JSON is no object");
  const auto asset = json_.find("asset");
  const bool has_asset = asset != json_.end() && asset->is_object();
  const auto version = has_asset ? asset->find("version") : json_.end();
  const std::string what = has_asset && version != asset->end() && version->is_string()
                               ? version->get<std::string>()
                               : "";
  const auto meshes = json_.find("meshes");  // a list in glTF 2
  const bool is_one = meshes != json_.end() && meshes->is_object();
  const std::string major = is_one ? "1" : what.substr(0, what.find('.'));
  if (!major.empty() && major != "2") fail(is_other_version(major));
  if (!has_asset) fail("is no glTF file: its JSON has no 'asset'");
}

std::size_t GltfFile::count(const char* array) const {
  const auto found = json_.find(array);
  if (found == json_.end()) return 0;
  if (!found->is_array()) fail(fmt::format("'{}' is no list", array));
  return found->size();
}

const GltfFile::Json& GltfFile::item(const char* array, std::size_t i) const {
  if (i >= count(array)) fail(fmt::format("names {}[{}], which does not exist", array, i));
  const Json& found = json_[array][i];
  if (!found.is_object()) fail(fmt::format("{}[{}] is no object", array, i));
  return found;
}

std::size_t GltfFile::size(const Json& object, const char* key, std::size_t fallback) const {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  const double value = found->is_number() ? found->get<double>() : -1.0;
  if (!(value >= 0.0 && value < 9e15) || value != std::floor(value)) {
    fail(fmt::format("'{}' is {}, and no count", key, found->dump().substr(0, 60)));
  }
  return static_cast<std::size_t>(value);
}

std::optional<std::size_t> GltfFile::index(const Json& object, const char* key,
                                           const char* array) const {
  if (!object.contains(key)) return std::nullopt;
  const std::size_t i = size(object, key, 0);
  item(array, i);
  return i;
}

std::vector<double> GltfFile::list(const Json& object, const char* key,
                                   std::vector<double> fallback) const {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  std::vector<double> out;
  const bool is_list = found->is_array();
  for (const Json& value : is_list ? *found : Json::array()) {
    if (value.is_number()) out.push_back(value.get<double>());
  }
  const bool is_whole = is_list && out.size() == found->size();
  if (!is_whole || (!fallback.empty() && out.size() != fallback.size())) {
    fail(fmt::format("'{}' is {}, and no list of {}numbers", key, found->dump().substr(0, 60),
                     fallback.empty() ? "" : fmt::format("{} ", fallback.size())));
  }
  return out;
}

std::vector<std::size_t> GltfFile::indices(const Json& object, const char* key,
                                           const char* array) const {
  std::vector<std::size_t> out;
  for (const double value : list(object, key, {})) {
    if (!(value >= 0.0 && value < 9e15)) fail(fmt::format("'{}' holds {}", key, value));
    out.push_back(static_cast<std::size_t>(value));
    item(array, out.back());
  }
  return out;
}

std::string_view GltfFile::buffer(std::size_t i) {
  if (const auto found = buffers_.find(i); found != buffers_.end()) return found->second;
  const Json& from = item("buffers", i);
  const auto uri = from.find("uri");
  if (uri == from.end()) {
    if (i != 0 || !chunk_) fail(fmt::format("buffers[{}] has no bytes", i));
    return *chunk_;
  }
  if (!uri->is_string()) fail(fmt::format("the uri of buffers[{}] is no text", i));
  const std::string& name = uri->get_ref<const std::string&>();
  std::string& bytes = buffers_[i];
  if (name.starts_with("data:")) {
    const auto decoded = bytes_of_data_uri(name);
    if (!decoded) fail(fmt::format("the data of buffers[{}] are no base64", i));
    bytes = *decoded;
    return bytes;
  }
  const std::filesystem::path file = file_of_uri(path_, name);
  if (file.empty()) fail(fmt::format("its buffer '{}' is not there", name.substr(0, 100)));
  bytes = read_file(file);
  files_.push_back(file);
  if (bytes.starts_with("version https://git-lfs")) {
    fail(fmt::format("its buffer '{}' is a Git LFS pointer: git lfs pull", name));
  }
  return bytes;
}

std::string_view GltfFile::view(std::size_t i) {
  const Json& from = item("bufferViews", i);
  const auto index_of_buffer = index(from, "buffer", "buffers");
  if (!index_of_buffer) fail(fmt::format("bufferViews[{}] names no buffer", i));
  const std::string_view bytes = buffer(*index_of_buffer);
  const std::size_t begin = size(from, "byteOffset", 0);
  const std::size_t length = size(from, "byteLength", 0);
  if (begin > bytes.size() || length > bytes.size() - begin) {
    fail(fmt::format("bufferViews[{}] reaches to byte {} of buffers[{}], which has {}", i,
                     begin + length, *index_of_buffer, bytes.size()));
  }
  return bytes.substr(begin, length);
}

void GltfFile::read_rows(std::string_view bytes, std::size_t stride, int type, bool is_share,
                         std::size_t first, std::size_t rows, GltfNumbers& out) const {
  const GltfComponent* const component = component_of(type);
  if (component == nullptr) fail(fmt::format("an accessor has the componentType {}", type));
  const std::size_t row_bytes = out.width * component->bytes;
  if (stride == 0) stride = row_bytes;
  if (rows == 0) return;
  const bool fits = first <= bytes.size() && row_bytes <= bytes.size() - first &&
                    (rows - 1) <= (bytes.size() - first - row_bytes) / stride;
  if (!fits) {
    fail(fmt::format("an accessor of {} rows reaches beyond its bufferView of {} bytes", rows,
                     bytes.size()));
  }
  out.values.reserve(rows * out.width);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < out.width; ++k) {
      const double value = component->at(bytes.data() + first + i * stride + k * component->bytes);
      out.values.push_back(is_share ? std::max(value / component->full, -1.0) : value);
    }
  }
}

void GltfFile::read_sparse(const Json& sparse, int component, bool is_share, GltfNumbers& out) {
  const auto part = [&](const char* key) -> const Json& {
    const auto found = sparse.is_object() ? sparse.find(key) : sparse.end();
    if (found == sparse.end() || !found->is_object()) {
      fail(fmt::format("a sparse accessor has no '{}'", key));
    }
    return *found;
  };
  const std::size_t count = sparse.is_object() ? size(sparse, "count", 0) : 0;
  GltfNumbers at, values;
  values.width = out.width;
  const auto read = [&](const Json& from, int type, bool is_of_shares, GltfNumbers& to) {
    const auto of_view = index(from, "bufferView", "bufferViews");
    if (!of_view) fail("a sparse accessor names no bufferView");
    read_rows(view(*of_view), 0, type, is_of_shares, size(from, "byteOffset", 0), count, to);
  };
  read(part("indices"), static_cast<int>(size(part("indices"), "componentType", 0)), false, at);
  read(part("values"), component, is_share, values);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = at.values[i];
    if (!(row >= 0.0 && row < static_cast<double>(out.rows()))) {
      fail(fmt::format("a sparse accessor sets row {} of {}", row, out.rows()));
    }
    std::copy_n(values.row(i), out.width,
                out.values.begin() +
                    static_cast<std::ptrdiff_t>(row) * static_cast<std::ptrdiff_t>(out.width));
  }
}

GltfNumbers GltfFile::numbers(std::size_t accessor, std::size_t width) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 7> kWidths = {{{"SCALAR", 1},
                                                                                {"VEC2", 2},
                                                                                {"VEC3", 3},
                                                                                {"VEC4", 4},
                                                                                {"MAT2", 4},
                                                                                {"MAT3", 9},
                                                                                {"MAT4", 16}}};
  constexpr std::size_t kMostZeros = std::size_t{1} << 24U;  // rows that no byte stands for
  const Json& from = item("accessors", accessor);
  const std::string type =
      from.contains("type") && from["type"].is_string() ? from["type"].get<std::string>() : "";
  const bool fits = std::any_of(kWidths.begin(), kWidths.end(), [&](const auto& known) {
    return known.first == type && known.second == width;
  });
  if (!fits) {
    fail(fmt::format("accessors[{}] is of type '{}', not of {} numbers", accessor, type, width));
  }
  GltfNumbers out;
  out.width = width;
  const std::size_t rows = size(from, "count", 0);
  const auto component = static_cast<int>(size(from, "componentType", 0));
  const bool is_share = from.contains("normalized") && from["normalized"] == true;
  if (const auto of_view = index(from, "bufferView", "bufferViews")) {
    read_rows(view(*of_view), size(item("bufferViews", *of_view), "byteStride", 0), component,
              is_share, size(from, "byteOffset", 0), rows, out);
  } else if (rows <= kMostZeros) {
    out.values.assign(rows * width, 0.0);
  } else {
    fail(fmt::format("accessors[{}] has {} rows and no bytes", accessor, rows));
  }
  if (from.contains("sparse")) read_sparse(from["sparse"], component, is_share, out);
  return out;
}

const GltfFile::Json& object_in(const GltfFile::Json& object, const char* key) {
  static const GltfFile::Json kNone = GltfFile::Json::object();
  const auto found = object.find(key);
  return found != object.end() && found->is_object() ? *found : kNone;
}

std::string text_in(const GltfFile::Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace gnbv
