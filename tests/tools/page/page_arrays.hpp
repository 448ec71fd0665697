// Arrays of a page read back as a browser reads them: by what the JSON says of each.
#pragma once

#include <cstring>
#include <string>
#include <vector>

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

}  // namespace gnbv::test
