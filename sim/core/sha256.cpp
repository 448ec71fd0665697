#include "sim/core/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include "sim/core/error.hpp"

namespace gnbv {

struct Sha256::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~State() { EVP_MD_CTX_free(context); }
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  GNBV_CHECK(EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) == 1, "OpenSSL");
}

Sha256::~Sha256() = default;

void Sha256::add_bytes(std::span<const std::byte> bytes) {
  GNBV_CHECK(EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()) == 1, "OpenSSL");
}

std::array<std::uint8_t, 32> Sha256::digest() {
  std::array<std::uint8_t, 32> digest{};
  GNBV_CHECK(EVP_DigestFinal_ex(state_->context, digest.data(), nullptr) == 1, "OpenSSL");
  return digest;
}

std::string Sha256::hex() { return fmt::format("{:02x}", fmt::join(digest(), "")); }

}  // namespace gnbv
