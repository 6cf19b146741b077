// SPDX-License-Identifier: Apache-2.0
// Any bytes as a scenario: it is read, or refused with one line per problem; never a crash, a hang
// or a leak. Linked with libFuzzer (tools/dev/fuzz) or with generate.cpp (the tests).
#include "base/error.hpp"
#include "fuzz/patience.hpp"
#include "preflight/derived.hpp"
#include "preflight/reader.hpp"
#include "unit/scenario/fake_models.hpp"

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

namespace {

namespace fs = std::filesystem;

/// One file per process, in memory where the system offers that.
const fs::path& input_file() {
  static const fs::path file = [] {
    const fs::path memory = "/dev/shm";
    const fs::path folder = fs::is_directory(memory) ? memory : fs::temp_directory_path();
    return folder / ("dust_fuzz_" + std::to_string(::getpid()) + ".yaml");
  }();
  return file;
}

/// Ends the program with what is wrong, for the fuzzer to keep the input.
[[noreturn]] void broken(const std::string& what) {
  std::cerr << "broken: " << what << '\n';
  std::abort();
}

void check_lines(const std::vector<std::string>& lines) {
  if (lines.empty()) broken("refused without a word");
  for (const std::string& line : lines) {
    if (line.find("error: ") == std::string::npos) broken("no diagnostic: " + line);
    for (const char c : line) {
      if (static_cast<unsigned char>(c) < 0x20) broken("a control character in: " + line);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto registry = fake::registry();
  const dust::fuzz::Patience patience;
  {
    std::ofstream stream(input_file(), std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  try {
    const auto result = dust::preflight::read_scenario(input_file(), {}, *registry);
    // What is accepted is written out, and read again as the same.
    std::ofstream(input_file(), std::ios::binary | std::ios::trunc) << result.resolved_yaml;
    const auto again = dust::preflight::read_scenario(input_file(), {}, *registry);
    if (again.resolved_yaml != result.resolved_yaml) broken("the resolved scenario changes");
  } catch (const dust::base::UserError& problem) {
    check_lines(problem.lines());
  }
  fs::remove(input_file());
  return 0;
}
