#include "sim/core/sha256.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

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

std::string Sha256::hex() {
  std::array<unsigned char, 32> digest{};
  GNBV_CHECK(EVP_DigestFinal_ex(state_->context, digest.data(), nullptr) == 1, "OpenSSL");
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace gnbv
