
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/sweep/manifest.hpp"

namespace gnbv {
namespace {

std::vector<Cell> cells_in(const std::string& manifest) {
  TempFolder temp;
  temp.write("sweep.json", manifest);
  return cells_of_manifest(temp.path());
}

std::string manifest_of(const std::string& cells, int schema = 1) {
  return fmt::format(R"({{"schema":{},"cells":[{}]}})", schema, cells);
}

std::string cell_of(const std::string& seed) {
  return R"({"index":0,"id":"ab","scenario":"s","method":"m","seed":)" + seed + "}";
}

TEST(Manifest, WhatIsNoneIsRefusedByName) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "sweep.json: "},
      {"[1]", "sweep.json: "},
      {"{}", "sweep.json: "},
      {manifest_of(""), "sweep.json: "},
      {manifest_of(R"({"id":"ab"})"), "sweep.json: "},
      {manifest_of(cell_of("\"x\"")), "sweep.json: seed: value '"},
      {manifest_of(cell_of("-1")), "sweep.json: seed: value '"},
      {manifest_of(cell_of("1.5")), "sweep.json: seed: value '"},
      {manifest_of(cell_of("1e3")), "sweep.json: seed: value '"},
      {manifest_of(cell_of("3") + "," + cell_of("3")), "sweep.json: two cells of s, m, seed 3"},
      {manifest_of(cell_of("3"), 2), "sweep.json: schema: value '2': expects 1"}};
  for (const auto& [manifest, says] : cases) {
    EXPECT_TRUE(test::says(test::fault_of([&, &text = manifest] { cells_in(text); }), {says}))
        << manifest;
  }
  TempFolder empty;
  EXPECT_THROW(cells_of_manifest(empty.path()), BadInput);
}

}  // namespace
}  // namespace gnbv
