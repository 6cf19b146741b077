// SPDX-License-Identifier: Apache-2.0
#include "scenario/text/suggest.hpp"

#include <algorithm>
#include <cctype>

namespace dust::scenario {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Optimal string alignment distance, case ignored.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_back(b.size() + 1);
  std::vector<std::size_t> back(b.size() + 1);
  std::vector<std::size_t> now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) back[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      now[j] = std::min({back[j] + 1, now[j - 1] + 1, back[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1])) {
        now[j] = std::min(now[j], two_back[j - 2] + 1);
      }
    }
    std::swap(two_back, back);
    std::swap(back, now);
  }
  return back[b.size()];
}

constexpr std::size_t k_longest_word = 64;

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.empty() || word.size() > k_longest_word) return {};
  std::string best;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t n = edits(word, candidate);
    if (n < fewest) {
      fewest = n;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       std::string_view label) {
  if (candidates.empty()) return {};
  const std::string best = nearest(word, candidates);
  if (!best.empty()) return "; did you mean '" + best + "'?";
  return "; " + std::string(label) + ": " + listed(candidates);
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string printable(std::string_view text) {
  constexpr std::size_t k_longest = 60;
  std::string shown;
  for (const char c : text.substr(0, k_longest)) {
    shown += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  if (text.size() <= k_longest) return shown;
  // Never cut inside a character.
  while (!shown.empty() && (text[shown.size()] & 0xC0) == 0x80) shown.pop_back();
  return shown + "...";
}

std::string in_quotes(std::string_view text) {
  std::string result(1, '\'');
  result.append(printable(text));
  result.push_back('\'');
  return result;
}

}  // namespace dust::scenario
