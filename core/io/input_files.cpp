// SPDX-License-Identifier: Apache-2.0
#include "io/input_files.hpp"

#include "io/run_files.hpp"

#include <fstream>

namespace dust::io {

std::string content_sha256(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  constexpr std::size_t k_piece = std::size_t{1} << 20;
  std::vector<char> piece(k_piece);
  Sha256 digest;
  while (in) {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    digest.update(piece.data(), static_cast<std::size_t>(in.gcount()));
  }
  return in.bad() ? std::string() : digest.hex_digest();
}

}  // namespace dust::io
