#include "core/digest.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <bit>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "core/error.h"

namespace fracbench {

namespace {
static_assert(std::endian::native == std::endian::little, "digests are defined on little endian");
}

struct Digest::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~State() { EVP_MD_CTX_free(context); }

  void update(const void* data, std::size_t size) {
    if (EVP_DigestUpdate(context, data, size) != 1) throw std::runtime_error("SHA-256 failed");
  }
  std::array<unsigned char, 32> finish() {
    std::array<unsigned char, 32> sum{};
    if (EVP_DigestFinal_ex(context, sum.data(), nullptr) != 1) {
      throw std::runtime_error("SHA-256 failed");
    }
    return sum;
  }
};

Digest::Digest() : state_(std::make_unique<State>()) {
  if (EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available");
  }
}

Digest::~Digest() = default;

void Digest::add(std::span<const std::byte> bytes) {
  const std::uint64_t size = bytes.size();
  state_->update(&size, sizeof size);
  state_->update(bytes.data(), bytes.size());
}

void Digest::add(std::string_view text) { add(std::as_bytes(std::span(text))); }

void Digest::add(std::span<const std::string_view> parts) {
  std::uint64_t size = 0;
  for (const std::string_view part : parts) size += part.size();
  state_->update(&size, sizeof size);
  for (const std::string_view part : parts) state_->update(part.data(), part.size());
}

void Digest::add_file(const std::filesystem::path& file) {
  constexpr std::size_t kPart = 1 << 18;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff end = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  const auto size = static_cast<std::uint64_t>(end);
  state_->update(&size, sizeof size);
  stream.seekg(0);
  std::vector<char> part(kPart);
  std::streamoff seen = 0;
  while (seen < end && stream) {
    stream.read(part.data(), static_cast<std::streamsize>(part.size()));
    state_->update(part.data(), static_cast<std::size_t>(stream.gcount()));
    seen += stream.gcount();
  }
  if (end < 0 || seen < end) throw InputError(fmt::format("'{}' cannot be read", file.string()));
}

void Digest::add(std::uint64_t value) { add(std::as_bytes(std::span(&value, 1))); }

void Digest::add(double value) { add(std::as_bytes(std::span(&value, 1))); }

void Digest::add(const TriangleMesh& mesh) {
  add(std::as_bytes(std::span(mesh.vertices)));
  add(std::as_bytes(std::span(mesh.faces)));
}

std::string Digest::hex() {
  std::string text;
  for (const unsigned char byte : state_->finish()) text += fmt::format("{:02x}", byte);
  return text;
}

std::uint64_t Digest::word() {
  const auto sum = state_->finish();
  std::uint64_t value = 0;
  for (int k = 0; k < 8; ++k) value |= static_cast<std::uint64_t>(sum[k]) << (8 * k);
  return value;
}

}  // namespace fracbench
