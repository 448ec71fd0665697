// Runs a fuzz target over the files of a folder, where libFuzzer is not to be had.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>

#include "sim/core/file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: {} CORPUS\n", argv[0]);
    return 2;
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    const std::string bytes = gnbv::read_file(entry.path());
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    ++files;
  }
  fmt::print("{} inputs\n", files);
  return files > 0 ? 0 : 1;
}
