#include "assets/catalog.hpp"

#include <algorithm>
#include <array>

#include "assets/aircraft.hpp"
#include "assets/lab_airplane.hpp"
#include "assets/lab_model.hpp"
#include "assets/power_plant.hpp"
#include "assets/smoke.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

struct Entry {
  std::string_view name;
  TriangleMesh (*make)();
};

constexpr std::array kCatalog = {
    Entry{"aircraft", make_aircraft},     Entry{"power_plant", make_power_plant},
    Entry{"lab_model", make_lab_model},   Entry{"lab_airplane", make_lab_airplane},
    Entry{"smoke", make_smoke_structure},
};

}  // namespace

TriangleMesh make_builtin_structure(std::string_view name) {
  const auto* const entry = std::find_if(kCatalog.begin(), kCatalog.end(),
                                         [&](const Entry& e) { return e.name == name; });
  GNBV_CHECK(entry != kCatalog.end(), "no structure is called '{}'", name);
  return entry->make();
}

}  // namespace gnbv
