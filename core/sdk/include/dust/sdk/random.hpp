// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace dust::sdk {

/// Counter-based random numbers: a pure function of (seed, stream, id, step), so that no draw
/// depends on the order in which threads ask for it. Philox 4x32-10 of Salmon et al., "Parallel
/// random numbers: as easy as 1, 2, 3", SC11 (2011), doi:10.1145/2063384.2063405.
class Random {
 public:
  Random(std::uint64_t seed, std::uint32_t stream) : seed_(seed), stream_(stream) {}

  /// A number uniform in (0, 1), 53 bits; `slot` tells several draws of one (id, step) apart.
  [[nodiscard]] double uniform(std::uint64_t id, std::uint32_t step, std::uint32_t slot = 0) const {
    const auto words =
        philox({static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(id >> 32), step, slot});
    const std::uint64_t bits =
        (static_cast<std::uint64_t>(words[0]) << 32 | words[1]) >> 11;  // 53 of 64 bits
    return (static_cast<double>(bits) + 0.5) * 0x1.0p-53;
  }

 private:
  using Words = std::array<std::uint32_t, 4>;

  [[nodiscard]] Words philox(Words counter) const {
    std::uint32_t key0 = static_cast<std::uint32_t>(seed_) ^ stream_ * 0x85EBCA6Bu;
    std::uint32_t key1 = static_cast<std::uint32_t>(seed_ >> 32) ^ stream_;
    for (int round = 0; round < 10; ++round) {
      const std::uint64_t p0 = 0xD2511F53ull * counter[0];
      const std::uint64_t p1 = 0xCD9E8D57ull * counter[2];
      counter = {
          static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ key0, static_cast<std::uint32_t>(p1),
          static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ key1, static_cast<std::uint32_t>(p0)};
      key0 += 0x9E3779B9u;
      key1 += 0xBB67AE85u;
    }
    return counter;
  }

  std::uint64_t seed_;
  std::uint32_t stream_;
};

/// The stream number of a name (FNV-1a), for Random.
constexpr std::uint32_t stream_of(const char* name) {
  std::uint32_t hash = 2166136261u;
  for (; *name != '\0'; ++name) hash = (hash ^ static_cast<unsigned char>(*name)) * 16777619u;
  return hash;
}

}  // namespace dust::sdk
