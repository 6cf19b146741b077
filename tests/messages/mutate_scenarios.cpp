// SPDX-License-Identifier: Apache-2.0
// Every key and every value of every shipped scenario done wrong, one at a time: each mistake is
// refused with file, line and column, before anything runs.
//
// usage: mutate_scenarios SCENARIOS PLUGINS ENGINE STRIDE
// STRIDE 1 takes every mistake; n takes every n-th, beginning at another place for each scenario.
#include "base/error.hpp"
#include "messages/places.hpp"
#include "preflight/reader.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/text/overlay.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using dust::test::Mistake;
using dust::test::Place;

/// Every so many refused mistakes one is given to the program itself.
constexpr std::size_t k_program_every = 400;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}
void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

/// In memory where the system offers that: a file is written for every mistake.
fs::path fast_folder() {
  const fs::path memory = "/dev/shm";
  return fs::is_directory(memory) ? memory : fs::temp_directory_path();
}

/// Offset of a mark in a file; columns count characters, not bytes.
std::size_t offset_of(const std::string& text, const dust::scenario::Mark& where) {
  std::size_t at = 0;
  for (int line = 1; line < where.line; ++line) at = text.find('\n', at) + 1;
  for (int column = 1; column < where.column; ++column) {
    do {
      ++at;
    } while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0u) == 0x80u);
  }
  return at;
}

/// Length of what stands at the place in the file; 1 for the bracket of a list.
std::size_t length_of(const std::string& text, std::size_t at, const Place& place) {
  if (place.kind == Place::Kind::list) return text[at] == '[' ? 1 : 0;
  if (text[at] == '\'' || text[at] == '"') return text.find(text[at], at + 1) + 1 - at;
  return text.compare(at, place.text.size(), place.text) == 0 ? place.text.size()
                                                              : std::string::npos;
}

class Mutator {
 public:
  Mutator(const fs::path& scenarios, const fs::path& plugins, fs::path engine)
      : folder_(fast_folder() / ("dust_mutants_" + std::to_string(::getpid()))),
        plugins_(plugins),
        engine_(std::move(engine)) {
    fs::copy(scenarios, folder_, fs::copy_options::recursive);
    registry_.load({plugins});
  }
  ~Mutator() {
    std::error_code code;
    fs::remove_all(folder_, code);
  }
  Mutator(const Mutator&) = delete;
  Mutator& operator=(const Mutator&) = delete;

  void walk(std::size_t stride) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      // Files that are only included elsewhere are walked from there.
      if (!problems(file).empty()) continue;
      ++scenarios_;
      scenario(file, stride);
    }
  }
  [[nodiscard]] int summary() const {
    for (const auto& [what, count] : counts_) std::cout << "  " << count << " x " << what << '\n';
    std::cout << scenarios_ << " scenarios, " << seen_.size() << " places, " << mistakes_
              << " mistakes (" << allowed_ << " of them allowed values), " << by_program_
              << " by the program; " << failures_ << " wrong\n";
    return failures_ == 0 && scenarios_ > 0 && by_program_ > 0 ? 0 : 1;
  }

 private:
  [[nodiscard]] std::vector<std::string> problems(const fs::path& file) const {
    try {
      (void)dust::preflight::read_scenario(file, {}, registry_);
    } catch (const dust::base::UserError& problem) {
      return problem.lines();
    }
    return {};
  }
  void fail(const Place& place, const Mistake& mistake, const std::string& why) {
    if (++failures_ > 50) return;
    std::cout << fs::relative(place.where.file, folder_).string() << ":" << place.where.line << ":"
              << place.where.column << ": " << place.path << " = " << mistake.replacement << " ("
              << mistake.what << "): " << why << '\n';
  }

  void scenario(const fs::path& file, std::size_t stride) {
    dust::scenario::Diagnostics diagnostics;
    const auto root = dust::scenario::read_with_includes(file, diagnostics);
    const auto places = dust::test::places_of(*root, registry_);
    std::size_t turn = std::hash<std::string>{}(fs::relative(file, folder_).string());
    for (const Place& place : places) {
      const auto id = std::make_tuple(place.where.file, place.where.line, place.where.column,
                                      place.kind == Place::Kind::text);
      if (!seen_.insert(id).second) continue;
      const std::string original = text_of(place.where.file);
      for (const Mistake& mistake : dust::test::mistakes_at(place)) {
        if (++turn % stride != 0) continue;
        one(file, original, place, mistake);
      }
      write(place.where.file, original);
    }
  }

  void one(const fs::path& file, const std::string& original, const Place& place,
           const Mistake& mistake) {
    std::string text = original;
    const std::size_t at = offset_of(text, place.where);
    const std::size_t length = length_of(text, at, place);
    if (length == std::string::npos) return fail(place, mistake, "is not where its mark says");
    // A key of a block has a line of its own.
    std::string replacement = mistake.replacement;
    const std::size_t line = text.rfind('\n', at) + 1;
    const bool is_block = text.find_first_not_of(" -", line) == at;
    if (mistake.what == "a key given twice" && is_block) {
      replacement = place.text + ": 1\n" + std::string(at - line, ' ') + place.text;
    }
    text.replace(at, length, replacement);
    write(place.where.file, text);
    ++mistakes_;
    ++counts_[mistake.what];
    try {
      const auto reported = problems(file);
      assess(place, mistake, reported);
      if (!reported.empty() && ++refused_ % k_program_every == 1) ask_program(file, place, mistake);
    } catch (const std::exception& problem) {
      fail(place, mistake, std::string("ends the program with: ") + problem.what());
    }
  }

  void assess(const Place& place, const Mistake& mistake,
              const std::vector<std::string>& reported) {
    if (reported.empty()) {
      if (mistake.must_be_refused) return fail(place, mistake, "is accepted");
      ++allowed_;
      return;
    }
    static const std::regex form(R"([^:\n]+:[1-9][0-9]*:[1-9][0-9]*: error: [^\n]+)");
    const auto begin = [&](int line) {
      return place.where.file + ":" + std::to_string(line) + ":";
    };
    // The second of two keys is told; in a block it has a line of its own.
    const bool is_twice = mistake.what == "a key given twice";
    bool is_reported = false;
    for (const std::string& one : reported) {
      if (!std::regex_match(one, form)) return fail(place, mistake, "no place in: " + one);
      is_reported = is_reported || one.starts_with(begin(place.where.line)) ||
                    (is_twice && one.starts_with(begin(place.where.line + 1)));
    }
    // A name that is changed is missed where it is used; values that contradict each other are told
    // at one of them; the YAML parser sees an unclosed bracket lines later.
    const bool is_local =
        mistake.must_be_refused && place.kind != Place::Kind::list && mistake.what != "garbage";
    if (is_local && !is_reported) fail(place, mistake, "is told elsewhere: " + reported.front());
  }

  /// `engine run`: exit status 2, nothing on standard output, no folder of results.
  void ask_program(const fs::path& file, const Place& place, const Mistake& mistake) {
    ++by_program_;
    const fs::path results = folder_ / "results";
    const fs::path output = folder_ / "output.txt";
    const std::string command = "env -u DUST_PLUGIN_PATH '" + engine_.string() + "' run '" +
                                file.string() + "' -o '" + results.string() + "' --plugin-path '" +
                                plugins_.string() + "' > '" + output.string() + "' 2> /dev/null";
    const int status = std::system(command.c_str());
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 2) {
      fail(place, mistake, "engine run ends with status " + std::to_string(status));
    }
    if (fs::exists(results)) fail(place, mistake, "engine run made a folder of results");
    if (fs::file_size(output) != 0) fail(place, mistake, "engine run writes to standard output");
    fs::remove_all(results);
  }

  fs::path folder_;
  fs::path plugins_;
  fs::path engine_;
  dust::registry::Registry registry_;
  std::set<std::tuple<std::string, int, int, bool>> seen_;
  std::map<std::string, int> counts_;
  int scenarios_ = 0;
  int mistakes_ = 0;
  int allowed_ = 0;
  int by_program_ = 0;
  int failures_ = 0;
  std::size_t refused_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: " << argv[0] << " SCENARIOS PLUGINS ENGINE STRIDE\n";
    return 2;
  }
  Mutator mutator(argv[1], argv[2], argv[3]);
  mutator.walk(std::max(1ul, std::strtoul(argv[4], nullptr, 10)));
  return mutator.summary();
}
