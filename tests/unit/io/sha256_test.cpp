// SPDX-License-Identifier: Apache-2.0
#include "io/run_files.hpp"

#include <doctest/doctest.h>

#include <string>

namespace {

std::string digest_of(const std::string& text) {
  dust::io::Sha256 hash;
  hash.update(text.data(), text.size());
  return hash.hex_digest();
}

}  // namespace

// Vectors of NIST's Cryptographic Algorithm Validation Program and of the examples to FIPS 180-4.
TEST_CASE("SHA-256 shall give the published digests") {
  CHECK(digest_of("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(digest_of("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(digest_of(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("SHA-256 shall not depend on how the bytes are cut into pieces") {
  const std::string text(777, 'x');
  const std::string whole = digest_of(text);
  for (const std::size_t piece : {1u, 7u, 63u, 64u, 65u, 128u}) {
    dust::io::Sha256 hash;
    for (std::size_t at = 0; at < text.size(); at += piece) {
      hash.update(text.data() + at, std::min(piece, text.size() - at));
    }
    CHECK(hash.hex_digest() == whole);
  }
}

TEST_CASE("SHA-256 shall pad correctly around the block boundary") {
  // 55, 56 and 64 bytes: one block, two blocks, one block and padding alone.
  CHECK(digest_of(std::string(55, 'a')) ==
        "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
  CHECK(digest_of(std::string(56, 'a')) ==
        "b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a");
  CHECK(digest_of(std::string(64, 'a')) ==
        "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb");
}
