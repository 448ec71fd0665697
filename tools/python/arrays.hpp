// NumPy arrays made of ours.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

namespace nb = nanobind;

/// rows x 5: x, y, z (m, world ENU), yaw (rad), gimbal pitch (rad).
using ViewRows = nb::ndarray<const double, nb::shape<-1, 5>, nb::c_contig, nb::device::cpu>;
using Point = std::array<double, 3>;

/// An array that owns its values, `columns` a row; 0 columns: one dimension.
template <typename T>
nb::object owned_array(std::vector<T> values, std::size_t columns = 0) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  T* const data = kept->data();
  const std::size_t count = kept->size();
  const nb::capsule owner(kept.release(),
                          [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  const std::array<std::size_t, 2> shape = {columns == 0 ? count : count / columns, columns};
  return nb::cast(nb::ndarray<nb::numpy, T>(data, columns == 0 ? 1 : 2, shape.data(), owner));
}

/// A view of values that `owner` keeps alive; nobody writes through it.
template <typename T>
nb::object shared_array(std::span<const T> values, std::span<const std::size_t> shape,
                        nb::handle owner) {
  return nb::cast(
      nb::ndarray<nb::numpy, const T>(values.data(), shape.size(), shape.data(), owner));
}

inline std::vector<ViewPose> views_of(const ViewRows& rows) {
  std::vector<ViewPose> views(rows.shape(0));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double* const row = rows.data() + 5 * i;
    views[i] = {Vec3(row[0], row[1], row[2]), row[3], row[4]};
  }
  return views;
}

inline nb::object array_of(std::span<const ViewPose> views) {
  std::vector<double> rows;
  for (const ViewPose& view : views) {
    const Vec3& p_m = view.p_world_m;
    rows.insert(rows.end(), {p_m.x(), p_m.y(), p_m.z(), view.yaw_rad, view.gimbal_pitch_rad});
  }
  return owned_array(std::move(rows), 5);
}

}  // namespace gnbv
