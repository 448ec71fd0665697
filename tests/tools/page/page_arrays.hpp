// Arrays of a page read back as a browser reads them, by what the JSON says of each; points for
// them.
#pragma once

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "sim/core/rng.hpp"
#include "tools/page/arrays.hpp"

namespace gnbv::test {

template <typename T>
std::vector<double> typed(const std::uint8_t* data, std::size_t count) {
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), data, sizeof(T) * count);
  return {values.begin(), values.end()};
}

/// The numbers of an array, row by row.
inline std::vector<double> numbers(const nlohmann::ordered_json& json,
                                   std::span<const std::uint8_t> bytes) {
  const std::string type = json["array"];
  const std::size_t count =
      json["shape"][0].get<std::size_t>() * json["shape"][1].get<std::size_t>();
  const std::uint8_t* data = bytes.data() + json["at"].get<std::size_t>();
  if (type == "uint8") return typed<std::uint8_t>(data, count);
  if (type == "int16") return typed<std::int16_t>(data, count);
  if (type == "uint16") return typed<std::uint16_t>(data, count);
  if (type == "uint32") return typed<std::uint32_t>(data, count);
  if (type == "float32") return typed<float>(data, count);
  if (type == "float64") return typed<double>(data, count);
  std::vector<double> out;
  if (type == "points") {
    out = typed<std::uint16_t>(data, count);
    for (std::size_t i = 0; i < count; ++i) {
      out[i] =
          json["min"][i % 3].get<double>() + json["size"][i % 3].get<double>() * out[i] / 65535;
    }
    return out;
  }
  while (type == "numbers" && out.size() < count) {
    double value = 0.0;
    for (double scale = 1.0;; scale *= 128.0) {
      value += scale * (*data & 127U);
      if (*data++ < 128) break;
    }
    out.push_back(value);
  }
  return out;
}

/// The same of a field of page_data.hpp.
template <typename Array>
std::vector<double> numbers(const Array& array, const page::Arrays& arrays) {
  return numbers(nlohmann::ordered_json(array), arrays.bytes());
}

/// In a cube of `size_m`.
inline std::vector<Vec3f> random_points(std::size_t count, float size_m, std::uint64_t seed) {
  std::vector<Vec3f> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto at = [&](std::uint64_t axis) {
      return size_m * static_cast<float>(uniform01({seed, Stream::bench, i, axis}));
    };
    points.emplace_back(at(0), at(1), at(2));
  }
  return points;
}

/// Points on a wavy sheet of 10 m by 10 m.
inline std::vector<Vec3f> sheet(std::size_t count) {
  std::vector<Vec3f> points = random_points(count, 10.0F, 7);
  for (Vec3f& p : points) p = {p.x() - 5.0F, p.y() - 5.0F, std::sin(p.x() - 5.0F) - 3.0F};
  return points;
}

}  // namespace gnbv::test
