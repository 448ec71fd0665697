#include "sim/core/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include "sim/core/error.hpp"

namespace gnbv {

Sha256::Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
  GNBV_CHECK(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1, "OpenSSL");
}

void Sha256::add_bytes(std::span<const std::byte> bytes) {
  GNBV_CHECK(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1, "OpenSSL");
}

std::array<std::uint8_t, 32> Sha256::digest() {
  std::array<std::uint8_t, 32> digest{};
  GNBV_CHECK(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1, "OpenSSL");
  return digest;
}

std::string Sha256::hex() { return fmt::format("{:02x}", fmt::join(digest(), "")); }

std::string sha256_of(std::string_view text) {
  Sha256 sha;
  sha.add(text);
  return sha.hex();
}

}  // namespace gnbv
