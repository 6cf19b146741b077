// SPDX-License-Identifier: Apache-2.0
#include "base/process/shell_word.hpp"
#include "base/utf8.hpp"

#include <doctest/doctest.h>

using dust::base::is_utf8;
using dust::base::shell_word;

TEST_CASE("a word shall come through a shell as it is") {
  CHECK(shell_word("results/slow-2") == "results/slow-2");
  CHECK(shell_word("my run") == "'my run'");
  CHECK(shell_word("it's") == "'it'\\''s'");
  CHECK(shell_word("$HOME") == "'$HOME'");
  CHECK(shell_word("") == "''");
}

TEST_CASE("UTF-8 shall be told from other bytes") {
  CHECK(is_utf8("plain"));
  CHECK(is_utf8("caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80"));
  CHECK_FALSE(is_utf8("caf\xE9"));
  CHECK_FALSE(is_utf8("\xC3"));
  CHECK_FALSE(is_utf8("\xC0\xAF"));          // overlong
  CHECK_FALSE(is_utf8("\xE0\x80\xAF"));      // overlong
  CHECK_FALSE(is_utf8("\xED\xA0\x80"));      // surrogate
  CHECK_FALSE(is_utf8("\xF4\x90\x80\x80"));  // above the last character
}
