// SPDX-License-Identifier: Apache-2.0
#include "run/summary/summary_emitters.hpp"

#include "base/named.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;

/// A size with its shares as asked (negative: no distribution was asked for) and as they came.
struct SizeRow {
  double diameter = 0.0;
  double asked_number = -1.0, asked_mass = -1.0;
  double real = 0.0, mass = 0.0;
};

std::vector<SizeRow> size_rows(const Simulation& s, std::size_t e) {
  std::vector<SizeRow> rows;
  const auto shares = s.models().emitters[e]->request().shares;
  rows.reserve(shares.size());
  double cubes = 0.0;
  for (const auto& share : shares) cubes += share.number_fraction * std::pow(share.diameter, 3);
  for (const auto& share : shares) {
    rows.push_back({.diameter = share.diameter,
                    .asked_number = share.number_fraction,
                    .asked_mass = share.number_fraction * std::pow(share.diameter, 3) / cubes});
  }
  for (const auto& line : s.insertion().ledger().lines_of(e)) {
    auto at = std::find_if(rows.begin(), rows.end(),
                           [&](const SizeRow& r) { return r.diameter == line.diameter; });
    if (at == rows.end()) at = rows.insert(rows.end(), {.diameter = line.diameter});
    at->real += line.weight * static_cast<double>(line.count);
    at->mass += line.weight * static_cast<double>(line.count) * line.grain_mass;
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const SizeRow& a, const SizeRow& b) { return a.diameter < b.diameter; });
  return rows;
}

/// Mass [kg] that a stream should have brought by now; 0 for others.
struct Asked {
  double before = 0.0;  ///< by other settings, in the run that this one started from: what came
  double here = 0.0;    ///< by its settings
  [[nodiscard]] double all() const { return before + here; }
};
/// By settings that are new in a branch nothing was asked for before.
Asked asked_of(const Simulation& s, const RunFacts& facts, std::size_t e) {
  const sdk::EmitterRequest r = s.models().emitters[e]->request();
  Asked asked;
  if (!(r.mass_flow > 0.0)) return asked;
  double begin = r.begin;
  if (facts.start) {
    const std::string& name = s.setup().emitters[e].name;
    const CountsBefore& before = facts.start->before;
    const auto& fresh = before.new_emitters;
    const auto* changed = base::find_named(before.changed_emitters, name);
    if (changed != nullptr) asked.before = changed->mass;
    if (changed != nullptr || std::find(fresh.begin(), fresh.end(), name) != fresh.end()) {
      begin = std::max(begin, facts.start->time);
    }
  }
  asked.here = r.mass_flow * std::max(0.0, std::min(s.time(), r.end) - begin);
  return asked;
}

std::int64_t waiting_of(const Simulation& s, std::size_t e) {
  return std::count_if(
      s.insertion().waiting().begin(), s.insertion().waiting().end(),
      [e](const InsertionCandidate& w) { return static_cast<std::size_t>(w.emitter) == e; });
}

/// A feed whose last grains wait for a fluid step has fallen short of nothing that anybody weighs.
constexpr double k_smallest_shortfall = 1e-2;

Json or_null(double value, bool is_given) { return is_given ? Json(value) : Json(nullptr); }

/// Many sizes of a file would drown the summary; their number is told.
constexpr std::size_t k_max_rows = 200;

}  // namespace

Json emitters_json(const Simulation& s, const RunFacts& facts) {
  Json all = Json::object();
  for (std::size_t e = 0; e < s.models().emitters.size(); ++e) {
    const auto r = s.models().emitters[e]->request();
    const auto came = s.insertion().ledger().totals_of(e);
    const double stream = asked_of(s, facts, e).all();
    Json j;
    j["model"] = s.setup().emitters[e].model.name;
    j["requested"] = {{"mass_flow_kg_per_s", or_null(r.mass_flow, r.mass_flow > 0.0)},
                      {"mass_kg", or_null(r.mass_flow > 0.0 ? stream : r.mass,
                                          r.mass_flow > 0.0 || r.mass > 0.0)},
                      {"count", r.count > 0 ? Json(r.count) : Json(nullptr)}};
    j["achieved"] = {{"mass_kg", came.mass}, {"computed", came.computed}, {"real", came.real}};
    j["waiting"] = waiting_of(s, e);
    const auto rows = size_rows(s, e);
    Json sizes = Json::array();
    for (std::size_t n = 0; n < rows.size() && rows.size() <= k_max_rows; ++n) {
      const SizeRow& row = rows[n];
      const bool is_asked = row.asked_number >= 0.0;
      sizes.push_back({{"diameter_m", row.diameter},
                       {"requested_number_fraction", or_null(row.asked_number, is_asked)},
                       {"achieved_number_fraction", came.real > 0.0 ? row.real / came.real : 0.0},
                       {"requested_mass_fraction", or_null(row.asked_mass, is_asked)},
                       {"achieved_mass_fraction", came.mass > 0.0 ? row.mass / came.mass : 0.0}});
    }
    j["number_of_sizes"] = rows.size();
    j["sizes"] = sizes;
    all[s.setup().emitters[e].name] = j;
  }
  return all;
}

void add_emitter_tables(const Simulation& s, Json& tables) {
  for (std::size_t e = 0; e < s.models().emitters.size(); ++e) {
    const auto came = s.insertion().ledger().totals_of(e);
    const auto rows = size_rows(s, e);
    if (came.computed == 0 || rows.size() > k_max_rows) continue;
    Json cells = Json::array();
    for (const SizeRow& row : rows) {
      const bool is_asked = row.asked_mass >= 0.0;
      cells.push_back({1e6 * row.diameter, or_null(1e2 * row.asked_mass, is_asked),
                       1e2 * row.mass / came.mass, or_null(1e2 * row.asked_number, is_asked),
                       1e2 * row.real / came.real});
    }
    tables.push_back({{"sensor", s.setup().emitters[e].name},
                      {"title", "Sizes released"},
                      {"columns",
                       {"diameter [um]", "mass asked [%]", "mass released [%]", "number asked [%]",
                        "number released [%]"}},
                      {"rows", cells}});
  }
}

std::vector<std::string> shortfalls(const Simulation& s, const RunFacts& facts) {
  std::vector<std::string> all;
  for (std::size_t e = 0; e < s.models().emitters.size(); ++e) {
    const std::int64_t waiting = waiting_of(s, e);
    const Asked asked = asked_of(s, facts, e);
    if (s.insertion().waiting_mass(e) <= k_smallest_shortfall * asked.here) continue;
    std::ostringstream text;
    text << "emitter '" << s.setup().emitters[e].name
         << "' falls short: " << base::mass_text(s.insertion().ledger().totals_of(e).mass, 4);
    if (asked.all() > 0.0) text << " of " << base::mass_text(asked.all(), 4);
    text << " came in; " << waiting << " grains wait because grains in the domain, or bodies that "
         << "move, take their places: make room in front of the emitter or reduce its flow";
    all.push_back(text.str());
  }
  return all;
}

}  // namespace dust::run
