#include "sim/core/base64.hpp"

#include <openssl/evp.h>

#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr int kMax = std::numeric_limits<int>::max() / 4 * 3 - 3;  // OpenSSL counts in int
  GNBV_CHECK(bytes.size() <= kMax, "{} bytes in one text", bytes.size());
  std::string text((bytes.size() + 2) / 3 * 4,
                   '\0');  // and the zero after it, which OpenSSL writes
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                  static_cast<int>(bytes.size()));
  return text;
}

}  // namespace gnbv
