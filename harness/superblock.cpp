#include "harness/superblock.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace fracbench {

namespace {

// With addresses of 8 bytes: signature, versions and flags (12), four addresses (32).
constexpr std::size_t kSummedBytes = 44;
constexpr std::size_t kVersionOffset = 8;

/// lookup3 of exactly kSummedBytes bytes, starting value 0.
std::uint32_t checksum(const char* bytes) {
  std::array<std::uint32_t, kSummedBytes / 4> words{};
  std::memcpy(words.data(), bytes, kSummedBytes);
  std::uint32_t a = 0xdeadbeef + kSummedBytes;
  std::uint32_t b = a;
  std::uint32_t c = a;
  std::size_t k = 0;
  for (; k + 3 < words.size(); k += 3) {
    a += words[k];
    b += words[k + 1];
    c += words[k + 2];
    constexpr int kShifts[] = {4, 6, 8, 16, 19, 4};
    for (int round = 0; round < 6; round += 3) {
      a -= c;
      a ^= std::rotl(c, kShifts[round]);
      c += b;
      b -= a;
      b ^= std::rotl(a, kShifts[round + 1]);
      a += c;
      c -= b;
      c ^= std::rotl(b, kShifts[round + 2]);
      b += a;
    }
  }
  a += words[k];
  b += words[k + 1];
  const auto finish = [](std::uint32_t& x, std::uint32_t y, int shift) {
    x ^= y;
    x -= std::rotl(y, shift);
  };
  finish(c, b, 14);
  finish(a, c, 11);
  finish(b, a, 25);
  finish(c, b, 16);
  finish(a, c, 4);
  finish(b, a, 14);
  finish(c, b, 24);
  return c;
}

}  // namespace

void renew_superblock_checksum(std::string& file) {
  if (file.size() < kSummedBytes + 4 || file[kVersionOffset] != 2) {
    throw std::logic_error("not an HDF5 file with a superblock of version 2");
  }
  const std::uint32_t sum = checksum(file.data());
  std::memcpy(file.data() + kSummedBytes, &sum, sizeof sum);
}

}  // namespace fracbench
