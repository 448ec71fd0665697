// Arrays of numbers in one block of bytes, and how the page's JSON names them: the type, the shape
// and the place of each. tools/web/src/page.ts puts a typed array in the place of such a name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv::page {

/// `rows` rows of so many numbers, `at` bytes from the beginning of the block.
template <typename T, std::size_t columns = 1>
struct Array {
  std::size_t at = 0;
  std::size_t rows = 0;
};

/// Points (n, 3) as 16-bit steps between the corners of their bounding box: off by at most
/// size / 131070 an axis. The page has them as float32.
struct Points {
  std::size_t at = 0;
  std::size_t rows = 0;
  std::array<float, 3> min_m{};
  std::array<float, 3> size_m{};
};

/// Whole numbers, small ones in few bytes: seven bits a byte, the lowest first, 128 set where more
/// follow (LEB128). The page has them as uint32.
struct Numbers {
  std::size_t at = 0;
  std::size_t rows = 0;
};

/// Little-endian arrays one after the other, each aligned for the typed arrays of a browser.
class Arrays {
 public:
  template <std::size_t columns = 1, typename T>
  Array<T, columns> add(const std::vector<T>& values) {
    static_assert(std::is_arithmetic_v<T>);
    return {append(values.data(), sizeof(T) * values.size()), values.size() / columns};
  }
  Points add_points(std::span<const Vec3f> points_m);
  Numbers add_numbers(std::span<const std::uint32_t> numbers);

  std::span<const std::uint8_t> bytes() const { return bytes_; }
  /// Takes back what was added since there were so many bytes.
  void cut(std::size_t bytes) { bytes_.resize(bytes); }

 private:
  std::size_t append(const void* data, std::size_t size);

  std::vector<std::uint8_t> bytes_;
};

template <typename T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8";
  if constexpr (std::is_same_v<T, std::int16_t>) return "int16";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "uint16";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "uint32";
  if constexpr (std::is_same_v<T, float>) return "float32";
  if constexpr (std::is_same_v<T, double>) return "float64";
}

template <typename T, std::size_t columns>
void to_json(nlohmann::ordered_json& json, const Array<T, columns>& array) {
  json = {{"array", type_name<T>()}, {"at", array.at}, {"shape", {array.rows, columns}}};
}
inline void to_json(nlohmann::ordered_json& json, const Points& points) {
  json = {{"array", "points"},
          {"at", points.at},
          {"shape", {points.rows, 3}},
          {"min", points.min_m},
          {"size", points.size_m}};
}
inline void to_json(nlohmann::ordered_json& json, const Numbers& numbers) {
  json = {{"array", "numbers"}, {"at", numbers.at}, {"shape", {numbers.rows, 1}}};
}

}  // namespace gnbv::page

/// null for what is not there.
template <typename T>
struct nlohmann::adl_serializer<std::optional<T>> {
  template <typename Json>
  static void to_json(Json& json, const std::optional<T>& value) {
    json = value ? Json(*value) : Json(nullptr);
  }
};
