// SPDX-License-Identifier: Apache-2.0
// Inputs for a fuzz target without libFuzzer: pieces of the seeds cut, doubled, swapped and mixed
// with what YAML and the reader find special. The same inputs for the same numbers.
//
// usage: PROGRAM COUNT FIRST SEED_FILE...
#include "dust/sdk/random.hpp"

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

const char* const k_pieces[] = {"{",
                                "}",
                                "[",
                                "]",
                                ": ",
                                "\n",
                                "  ",
                                "&a ",
                                "*a",
                                "- ",
                                "'",
                                "\"",
                                "#",
                                "!!int ",
                                "|\n",
                                ">\n",
                                "%YAML ",
                                "---\n",
                                "\t",
                                ",",
                                "? ",
                                "none",
                                "~",
                                "true",
                                "yes",
                                "0x1F",
                                "1e999",
                                "-1",
                                ".nan",
                                ".inf",
                                "1e-320",
                                "mm",
                                " kg/m3",
                                "include: ",
                                "model: ",
                                "<<: ",
                                "[0, 0]",
                                "periodic",
                                "\xff",
                                "\xc3\xa9",
                                "0",
                                "9999999999999999999",
                                "enabled: false\n"};

class Draws {
 public:
  explicit Draws(std::uint64_t input) : input_(input) {}
  std::size_t below(std::size_t count) {
    const double draw = random_.uniform(input_, step_++);
    return count == 0 ? 0 : static_cast<std::size_t>(draw * static_cast<double>(count));
  }

 private:
  dust::sdk::Random random_{3, dust::sdk::stream_of("fuzz")};
  std::uint64_t input_;
  std::uint32_t step_ = 0;
};

/// Begin and length of a line, so that changes keep most of the file meaningful.
std::pair<std::size_t, std::size_t> line(const std::string& text, Draws& draws) {
  const std::size_t at = draws.below(text.size());
  const std::size_t begin =
      text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at) + 1;
  const std::size_t end = std::min(text.find('\n', begin), text.size() - 1);
  return {begin, end < begin ? 0 : end - begin + 1};
}

std::string mutant(const std::vector<std::string>& seeds, std::uint64_t input) {
  Draws draws(input);
  std::string text = seeds[draws.below(seeds.size())];
  const std::size_t changes = 1 + draws.below(6);
  for (std::size_t n = 0; n < changes && !text.empty(); ++n) {
    const auto [begin, length] = line(text, draws);
    switch (draws.below(8)) {
      case 0:
        text.erase(begin, length);
        break;
      case 1:
        text.insert(begin, text.substr(begin, length));
        break;
      case 2: {
        const std::string& other = seeds[draws.below(seeds.size())];
        const auto [from, size] = line(other, draws);
        text.replace(begin, length, other.substr(from, size));
        break;
      }
      case 3:
        text.resize(begin);
        break;
      case 4:
        text[draws.below(text.size())] = static_cast<char>(draws.below(256));
        break;
      default:
        text.replace(draws.below(text.size()), draws.below(6),
                     k_pieces[draws.below(std::size(k_pieces))]);
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: " << argv[0] << " COUNT FIRST SEED_FILE...\n";
    return 2;
  }
  const std::uint64_t count = std::strtoull(argv[1], nullptr, 10);
  const std::uint64_t first = std::strtoull(argv[2], nullptr, 10);
  std::vector<std::string> seeds;
  for (int n = 3; n < argc; ++n) {
    std::ifstream file(argv[n], std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  using Clock = std::chrono::steady_clock;
  double slowest = 0.0;
  for (std::uint64_t n = first; n < first + count; ++n) {
    const std::string text = mutant(seeds, n);
    const auto begin = Clock::now();
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    const double taken = std::chrono::duration<double>(Clock::now() - begin).count();
    // A scenario is read in milliseconds; a busy machine may take a thousand times as long.
    if (taken > 10.0) {
      std::cerr << "input " << n << " took " << taken << " s\n";
      return 1;
    }
    slowest = std::max(slowest, taken);
  }
  std::cout << count << " inputs, the slowest took " << slowest << " s\n";
  return 0;
}
