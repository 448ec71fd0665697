#include <gtest/gtest.h>

#include <fstream>

#include "sim/core/error.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/sweep/manifest.hpp"

namespace gnbv {
namespace {

std::string fault_of(const std::string& manifest) {
  TempFolder temp;
  std::ofstream(temp.path() / "sweep.json") << manifest;
  try {
    cells_of_manifest(temp.path());
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

const std::string kCell = R"({"index":0,"id":"ab","scenario":"s","method":"m","seed":3})";

TEST(Manifest, CellsKeepTheirOrder) {
  TempFolder temp;
  std::ofstream(temp.path() / "sweep.json")
      << R"({"schema":1,"cells":[)" << kCell
      << R"(,{"index":1,"id":"cd","scenario":"s","method":"m","seed":1}]})";
  const std::vector<Cell> cells = cells_of_manifest(temp.path());
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(cells[0].id, "ab");
  EXPECT_EQ(cells[0].scenario, "s");
  EXPECT_EQ(cells[0].method, "m");
  EXPECT_EQ(cells[0].seed, 3U);
  EXPECT_EQ(cells[1].seed, 1U);
}

TEST(Manifest, WhatIsNoneIsRefusedByName) {
  for (const std::string text :
       {"", "[1]", "{}", R"({"schema":1,"cells":[]})", R"({"schema":1,"cells":[{"id":"ab"}]})",
        R"({"schema":1,"cells":[{"id":"ab","scenario":"s","method":"m","seed":"x"}]})"}) {
    EXPECT_NE(fault_of(text).find("sweep.json: "), std::string::npos) << text;
  }
  EXPECT_NE(fault_of(R"({"schema":1,"cells":[)" + kCell + "," + kCell + "]}")
                .find("two cells of s, m, seed 3"),
            std::string::npos);
  for (const std::string seed : {"-1", "1.5", "1e3"}) {
    EXPECT_NE(fault_of(R"({"schema":1,"cells":[{"id":"ab","scenario":"s","method":"m","seed":)" +
                       seed + "}]}")
                  .find("seed: value '"),
              std::string::npos)
        << seed;
  }
  EXPECT_NE(
      fault_of(R"({"schema":2,"cells":[)" + kCell + "]}").find("schema: value '2': expects 1"),
      std::string::npos);
  TempFolder empty;
  EXPECT_THROW(cells_of_manifest(empty.path()), BadInput);
}

}  // namespace
}  // namespace gnbv
